// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The searches of certificate.h for callers that have edges and trees already.

#include "box_tree.h"
#include "garmentfit/certificate.h"
#include "nearest.h"
#include "topology.h"

namespace garmentfit {

/// The edges of `a` through the triangles in the tree.
std::vector<Crossing> find_crossings(const TriangleMesh& a, const Edges& edges_of_a, const TriangleTree& tree_of_b);
/// The edges of `mesh` through its own triangles, neighbours left out.
std::vector<Crossing> find_self_crossings(const TriangleMesh& mesh, const Edges& edges, const TriangleTree& tree);

/// find_self_crossings of one mesh again and again, while it moves: its trees are renewed, not built, and only what has
/// moved is looked at.
class SelfCrossingSearch {
public:
    /// Keeps references: both have to live as long.
    SelfCrossingSearch(const Triangles& triangles, const Edges& edges) : triangles_(triangles), edges_(edges) { }
    std::vector<Crossing> find(const Positions& positions);

private:
    bool cross(const Positions& positions, int edge, int triangle) const;

    const Triangles& triangles_;
    const Edges& edges_;
    BoxTree edge_tree_, triangle_tree_;
    Positions positions_;  // last time
    std::vector<Crossing> crossings_;  // there
};

}  // namespace garmentfit
