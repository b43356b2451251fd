// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "garmentfit/types.h"

namespace garmentfit {

/// m, of the box about all vertices: the length that relative tolerances refer to.
double diagonal(const Positions& positions);

/// m^2, ascending: sums of the squared coordinates of points, from their middle, along their three principal axes.
Vec3 squared_extents(const Positions& points);

/// Whether points lie in a plane, however that lies: no further from it than a share of their longest extent, on the
/// mean. One point does.
bool is_flat(const Positions& points, double share);

/// m^2; the area of triangle `f` times its unit normal.
inline Vec3 area_vector(const Positions& positions, const Triangles& triangles, Eigen::Index f)
{
    const Vec3 a = positions.row(triangles(f, 0)), b = positions.row(triangles(f, 1)),
               c = positions.row(triangles(f, 2));
    return 0.5 * (b - a).cross(c - a);
}

/// m^2. O(n).
double area(const TriangleMesh& mesh);

/// m^2, of some faces. @param area_vectors  of all
double area(const std::vector<Vec3>& area_vectors, const std::vector<int>& faces);

/// Enclosed by a closed surface, negative where its triangles are turned inwards; m^3. O(n).
double volume(const TriangleMesh& closed);

}  // namespace garmentfit
