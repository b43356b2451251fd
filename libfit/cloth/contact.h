// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Which primitives of cloth come close to each other, to the body, or to the garments worn under the cloth.
//
// The vertices of cloth and obstacle are numbered together: the cloth's first, then the body's, then those of the
// layers. The obstacle is not compared with itself.

#include <unordered_set>
#include <vector>

#include "box_tree.h"
#include "proximity.h"
#include "topology.h"

namespace garmentfit {

/// What the cloth of a pair is near to: the body, a garment worn under it, or itself.
enum class ContactReason : unsigned char { body, layer, self };

struct ContactPair {
    PairKind kind;
    ContactReason reason;
    std::array<int, 4> vertices;
    ClosestPoints at;  ///< at the positions of the last detection
};

/// How far beside their paths vertices may go, metres.
struct Margins {
    double cloth, obstacle;
};

/// The body (its vertices come first) and the layers, in one mesh.
struct Obstacle {
    TriangleMesh mesh;
    int body_vertices;  ///< the others belong to layers
};

/// A surface with its edges, listed once by the caller.
struct ContactSurface {
    const Triangles& triangles;
    const Edges& edges;
    int vertices;
};

class ContactDetector {
public:
    /// Indices of both surfaces begin at 0.
    /// @param body_vertices  of the obstacle; its other vertices belong to layers
    /// @param spare          a search looks this much further than asked where little is moving: its pairs serve later
    ///                       detections, too, as long as no vertex leaves the region that was searched
    ContactDetector(const ContactSurface& cloth, const ContactSurface& obstacle, int body_vertices,
                    const Margins& spare = { 0, 0 });

    /// Finds all pairs that may meet when each vertex goes any fraction of its displacement, and up to its margin from
    /// there. Cost O(n + c log n) where a search is due, c pairs of overlapping boxes. It grows with the square of the
    /// margins once these are longer than the edges. Pairs of cloth that touch (distance 0) have no side to be kept on:
    /// they are ignored from then on.
    void detect(const Positions& x, const Positions& displacements, const Margins& margins);

    const std::vector<ContactPair>& pairs() const { return pairs_; }

private:
    struct Surface {
        Triangles triangles;  // in common numbers, as edges and vertices
        Edges edges;
        std::vector<int> vertices;  // those of triangles
        BoxTree vertex_tree, edge_tree, triangle_tree;
    };
    /// Where vertices may go: along their paths from their starts, and beside them.
    struct SweptRegion {
        Positions start, path;
        Margins margins;
    };
    /// A pair that may meet within the region searched.
    struct Candidate {
        PairKind kind;
        ContactReason reason;
        std::array<int, 4> vertices;
        std::uint64_t key;  // of its two primitives
        double distance;  // at the start of the region
    };
    /// What one part of a search finds.
    struct Found {
        std::vector<Candidate> apart, touching;
    };
    static Surface make_surface(const ContactSurface& surface, int offset);
    ContactReason reason_of(const std::array<int, 4>& vertices) const;
    /// How much further the last search would have had to look to serve for this region, as a share of the spare
    /// margins. 0 where it serves.
    double spare_lacking(const SweptRegion& region) const;
    bool has_same_obstacle(const SweptRegion& region) const;
    void refit_trees();
    void choose_spare(double lacking);
    void search(SweptRegion region);
    void find_vertex_faces(const Surface& a, const Surface& b, std::vector<Found>& parts);
    void find_edge_edges(const Surface& a, const Surface& b, std::vector<Found>& parts);
    void add_candidate(Candidate candidate, Found& found);
    std::unordered_set<std::uint64_t>& ignored(PairKind kind) { return ignored_[int(kind)]; }

    int cloth_vertices_, first_layer_vertex_;
    Surface cloth_, obstacle_;
    Margins spare_;
    SweptRegion region_;  // the one searched last
    bool has_spare_ = false;  // it was searched with the spare margins
    int detections_ = 0;  // since then
    bool is_path_empty_ = true;  // there
    bool obstacle_is_fitted_ = false;  // its trees are those of the region
    std::vector<Candidate> candidates_;  // all pairs that may meet there
    std::array<std::unordered_set<std::uint64_t>, 2> ignored_;  // by kind: pairs of cloth that touched
    std::vector<ContactPair> pairs_;
};

}  // namespace garmentfit
