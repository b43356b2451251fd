// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Nearest vertices of cloth, asked for from the middle of tubes, where many are nearly equally near: tight boxes tell most of them apart
// sooner than the cells of NearestPoint's KD-tree do. Same answers.

#include "box_hierarchy.h"

namespace garmentfit {

class VertexTree {
public:
    /// O(n log n).
    explicit VertexTree(const Positions& vertices);

    /// Of vertices equally near, the first.
    /// @param known  one of them is as near as that, m, which shortens the search
    int index(const Vec3& query, double known) const;

private:
    BoxHierarchy boxes_;
    Positions in_order_;  // of boxes_.items()
};

}  // namespace garmentfit
