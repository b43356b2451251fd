// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <vector>

#include "garmentfit/types.h"

namespace garmentfit {

using Box = Eigen::AlignedBox3d;

/// Of all vertices. Empty for no vertices.
Box box_of(const Positions& positions);

/// Whether any of some vertices is marked. @param marks  by vertex
template <class Vertices>
bool has_marked(const Vertices& vertices, const std::vector<char>& marks)
{
    return std::any_of(vertices.begin(), vertices.end(), [&](int v) { return marks[v]; });
}

/// The triangles whose boxes meet a box, in their order, and all vertices: what is outside of the box cannot meet what is
/// in it. O(n)
TriangleMesh part_in(const TriangleMesh& mesh, const Box& box);

}  // namespace garmentfit
