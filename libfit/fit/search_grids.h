// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The grids of a search, sorted by distance from the present: of equals, the nearest wins. And the rotations and
// reflections of its moves.

#include <vector>

#include "garmentfit/types.h"

namespace garmentfit {

/// Offsets of a cubic grid within `extent` along each axis, nearest first. Metres or radians.
std::vector<Vec3> grid_offsets(const Vec3& extent, double spacing);
inline std::vector<Vec3> grid_offsets(double extent, double spacing)
{
    return grid_offsets(Vec3::Constant(extent), spacing);
}

/// Directions within `extent` of `axis`, about `spacing` apart, nearest first. Radians.
std::vector<Vec3> directions_about(const Vec3& axis, double extent, double spacing);

/// The rotation about a vector by its length, radians.
Eigen::Quaterniond rotation_by(const Vec3& rotation_vector);

/// A direction in the mirror across the unit vector `axis`.
inline Vec3 reflect(const Vec3& direction, const Vec3& axis) { return direction - 2 * direction.dot(axis) * axis; }

}  // namespace garmentfit
