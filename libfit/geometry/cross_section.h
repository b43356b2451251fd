// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "garmentfit/types.h"

namespace garmentfit {

/// One closed outline where a plane cuts a closed surface.
struct CrossSection {
    Vec3 centroid = Vec3::Zero();  ///< of the area within
    double girth = 0;  ///< m, length of the outline
    double area = 0;  ///< m^2
    std::vector<Vec3> outline;  ///< counter-clockwise about the plane's normal
    std::vector<int> vertices;  ///< of the surface, one next to each point of the outline
};

/// Cuts a closed surface by planes. A limb that touches another one still has its own outline.
class Slicer {
public:
    explicit Slicer(const TriangleMesh& closed) : mesh_(closed) { }

    /// The outline of smallest area around `point` in the plane through it; empty when the point is outside. O(n).
    std::optional<CrossSection> cut(const Vec3& point, const Vec3& normal) const;

private:
    const TriangleMesh& mesh_;
};

}  // namespace garmentfit
