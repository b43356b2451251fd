// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Cloth against itself and against an obstacle (the body, and garments under it): which primitives come close, and how far
// everything may move so that nothing crosses.
//
// Vertices of both are numbered together: cloth first, then the obstacle. The obstacle does not meet itself.

#include <unordered_set>
#include <vector>

#include "box_tree.h"
#include "proximity.h"

namespace fit {

struct ContactPair {
    PairKind kind;
    bool self;                  ///< both primitives are cloth
    std::array<int, 4> vertices;
    Closest at;                 ///< where the pair was detected
};

class Contact {
public:
    using Edges = Eigen::Matrix<int, Eigen::Dynamic, 2, Eigen::RowMajor>;

    /// @param cloth     triangles over [0, cloth_vertices)
    /// @param obstacle  triangles over [0, obstacle_vertices), numbered from 0
    Contact(const Triangles& cloth, int cloth_vertices, const Triangles& obstacle, int obstacle_vertices);

    /// Primitives of the cloth around each crossing (edge, triangle) have no side to be kept on: they are left to
    /// pass. All pairs of a state that crosses already must be named before the first motion.
    void exempt(const std::vector<std::pair<int, int>>& self_crossings);

    /// Finds all pairs that may meet when no vertex moves further than its reach (metres). Pairs that touch already at
    /// the first detection (distance 0) are exempted.
    void detect(const Positions& x, const std::vector<double>& reach);

    const std::vector<ContactPair>& pairs() const { return pairs_; }

    /// The share of its displacement, in [0, 1], that each vertex may go so that no pair comes nearer than `gap` (see
    /// free_share). Displacements must keep within the reach of the detection. Same bits for any number of threads.
    std::vector<double> free_shares(const Positions& x, const Positions& displacements, double gap) const;

    const Edges& cloth_edges() const { return cloth_.edges; }

private:
    struct Surface {
        Triangles triangles;
        Edges edges;
        std::vector<int> vertices;  // those of triangles
        BoxTree vertex_tree, edge_tree, triangle_tree;
    };
    static Surface surface(const Triangles& triangles, int offset);
    void renew(Surface& surface, const Positions& x, const std::vector<double>& reach) const;

    Surface cloth_, obstacle_;
    std::unordered_set<std::uint64_t> passing_vertex_face_, passing_edge_edge_;
    std::vector<ContactPair> pairs_;
};

}  // namespace fit
