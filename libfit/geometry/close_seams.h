// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A garment whose panels share no vertex, as one surface.

#include <vector>

#include "garmentfit/types.h"
#include "sewn_pieces.h"
#include "topology.h"

namespace garmentfit {

/// Joins the borders that seams tie: vertices of the two borders that are close to each other become one, and the
/// others are inserted into the edges of the opposite border. Borders of pieces that are folded back on each other,
/// such as the hems of cloth and lining, stay open. So do ends of a border that reach beyond the other one.
/// @param topology  of mesh.triangles
/// @param ties      of the mesh (find_sewn_pieces); those that are no seams between pieces are ignored
/// @return the mesh with more triangles; some may be degenerate, and some vertices have none
/// Cost O(n log n).
TriangleMesh close_seams(const TriangleMesh& mesh, const MeshTopology& topology, const std::vector<Tie>& ties);

}  // namespace garmentfit
