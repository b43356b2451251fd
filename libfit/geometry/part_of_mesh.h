// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "garmentfit/types.h"

namespace garmentfit {

using Box = Eigen::AlignedBox3d;

/// Of all vertices. Empty for no vertices.
Box box_of(const Positions& positions);

/// The triangles whose boxes meet a box, in their order, and all vertices: what is outside of the box cannot meet what is
/// in it. O(n)
TriangleMesh part_in(const TriangleMesh& mesh, const Box& box);

}  // namespace garmentfit
