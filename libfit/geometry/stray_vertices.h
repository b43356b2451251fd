// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include "garmentfit/types.h"

namespace garmentfit {

/// The box of vertices, but for few at either end of each axis.
struct UsualBox {
    Eigen::AlignedBox3d box;

    UsualBox(const Positions& positions, const std::vector<int>& vertices);

    Vec3 middle() const { return box.min() + 0.5 * (box.max() - box.min()); }
    /// Of a place from the middle, in diagonals of the box; not a number where these overflow.
    double away(const Vec3& place) const;
};

/// Vertices that no face uses, and that are not finite or far from those that faces use: exporters leave them behind,
/// and no box should hold them. Empty where there are no faces. O(n).
std::vector<int> stray_vertices(const Positions& positions, const Triangles& triangles);

/// The same mesh with its stray vertices in the middle of the others.
Positions gather_strays(const Positions& positions, const Triangles& triangles);

}  // namespace garmentfit
