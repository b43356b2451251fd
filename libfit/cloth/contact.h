// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Cloth against itself and against an obstacle (the body, and garments under it): which primitives come close, and how far
// everything may move so that nothing crosses.
//
// What crosses must pass a state in which a vertex meets a face or an edge an edge. None does so here, so that crossings neither
// come nor go: those that a garment was given with stay the same pairs.
//
// Vertices of both are numbered together: cloth first, then the obstacle. The obstacle does not meet itself.

#include <unordered_set>
#include <vector>

#include "box_tree.h"
#include "proximity.h"

namespace garmentfit {

struct ContactPair {
    PairKind kind;
    bool self;  ///< both primitives are cloth
    std::array<int, 4> vertices;
    Closest at;  ///< where the pair was detected
};

/// How far (metres) beside their ways vertices may go.
struct Margins {
    double cloth, obstacle;
};

class Contact {
public:
    using Edges = Eigen::Matrix<int, Eigen::Dynamic, 2, Eigen::RowMajor>;

    /// @param cloth     triangles over [0, cloth_vertices)
    /// @param obstacle  triangles over the obstacle's vertices, numbered from 0
    /// @param spare     a search looks so much further than it is asked to: what it finds then serves later detections, too,
    ///                  for as long as nothing leaves the room that was searched
    Contact(const Triangles& cloth, int cloth_vertices, const Triangles& obstacle, const Margins& spare = { 0, 0 });

    /// Finds all pairs that may meet when each vertex goes any share of its displacement, and up to its margin from there.
    /// Cost O(n + c log n) where a search is due, c pairs of overlapping boxes; it grows with the square of the margins once
    /// they are longer than the edges. Pairs of cloth that touch (distance 0) have no side to be kept on: from then on they are left to pass.
    void detect(const Positions& x, const Positions& displacements, const Margins& margins);

    const std::vector<ContactPair>& pairs() const { return pairs_; }

    /// The share of its displacement, in [0, 1], that each vertex may go so that no pair comes nearer than `gap` (see
    /// free_share). `x` as at the last detection, the displacements among those given to it, its margins at least `gap`.
    /// Same bits for any number of threads.
    std::vector<double> free_shares(const Positions& x, const Positions& displacements, double gap) const;

    /// Displacements in which vertices of pairs that cannot go their ways apart from each other go together, with their mean.
    /// An obstacle of which no vertex is to move stays where it is, and what is locked to it stays, too. Same bits for any number of threads.
    Positions joined(const Positions& x, const Positions& displacements, double gap) const;

private:
    struct Surface {
        Triangles triangles;
        Edges edges;
        std::vector<int> vertices;  // those of triangles
        BoxTree vertex_tree, edge_tree, triangle_tree;
    };
    /// Where vertices may go: along their ways from their starts, and beside them.
    struct SweptRegion {
        Positions start, way;
        Margins margins;
    };
    /// A pair that may meet within the room searched.
    struct Candidate {
        PairKind kind;
        bool self;
        std::array<int, 4> vertices;
        std::uint64_t key;  // of its two primitives
        double distance;  // where the search began
    };
    static Surface surface(const Triangles& triangles, int offset);
    bool searched(const SweptRegion& region) const;
    void renew_trees();
    void search();
    std::unordered_set<std::uint64_t>& passing(PairKind kind) { return passing_[int(kind)]; }

    Surface cloth_, obstacle_;
    Eigen::Index cloth_vertices_;
    Margins spare_;
    SweptRegion searched_region_;
    std::vector<Candidate> candidates_;  // all that may meet in that room
    std::array<std::unordered_set<std::uint64_t>, 2> passing_;  // by kind: pairs of cloth that touched
    std::vector<ContactPair> pairs_;
};

}  // namespace garmentfit
