// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "garmentfit/types.h"

namespace garmentfit {

/// One closed outline where a plane cuts a closed surface.
struct CrossSection {
    Vec3 centroid = Vec3::Zero();  ///< of the area within
    double girth = 0;              ///< m, length of the outline
    double area = 0;               ///< m^2
    std::vector<Vec3> outline;     ///< counter-clockwise about the plane's normal
    std::vector<int> vertices;     ///< of the surface, one beside each point of the outline
};

/// Cuts one closed surface again and again. A limb that touches another one is still an outline of its own.
class Slicer {
public:
    explicit Slicer(const TriangleMesh& closed) : mesh_(closed) { }

    /// The smallest outline round `point` in the plane through it; nothing when the point is outside. O(n).
    std::optional<CrossSection> cut(const Vec3& point, const Vec3& normal) const;

private:
    const TriangleMesh& mesh_;
};

}  // namespace garmentfit
