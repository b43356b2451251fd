// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The searches of certificate.h for callers that have edges and trees already.

#include "garmentfit/certificate.h"
#include "nearest.h"
#include "topology.h"

namespace garmentfit {

/// The edges of `a` through the triangles in the tree.
std::vector<Crossing> find_crossings(const TriangleMesh& a, const Edges& edges_of_a, const TriangleTree& tree_of_b);
/// The edges of `mesh` through its own triangles, neighbours left out.
std::vector<Crossing> find_self_crossings(const TriangleMesh& mesh, const Edges& edges, const TriangleTree& tree);

}  // namespace garmentfit
