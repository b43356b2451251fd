// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Whether segments pass through a surface: boxes that are quick to build, and exact predicates at the end. (For distances, and for which
// triangles are met, there is TriangleTree.)

#include <array>
#include <vector>

#include "box_hierarchy.h"

namespace garmentfit {

class CrossingTree {
public:
    /// Triangles without area are left out. O(n log n).
    explicit CrossingTree(const TriangleMesh& surface);

    /// Exact. O(log n) for a segment that comes near few triangles.
    bool is_met(const Vec3& from, const Vec3& to) const;

private:
    std::vector<std::array<Vec3, 3>> triangles_;  // their corners
    BoxHierarchy boxes_;
};

}  // namespace garmentfit
