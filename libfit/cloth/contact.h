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
    /// @param spare          a search looks this much further than asked round vertices that hardly move: its pairs serve
    ///                       later detections, too, as long as these do not leave the region that was searched
    ContactDetector(const ContactSurface& cloth, const ContactSurface& obstacle, int body_vertices,
                    const Margins& spare = { 0, 0 });

    /// Finds all pairs that may meet when each vertex goes any fraction of its displacement, and up to its margin from
    /// there. Cost O(n + c log n), c pairs of overlapping boxes of which one has a vertex that left the region searched
    /// before. It grows with the square of the margins once these are longer than the edges. Pairs of cloth that touch
    /// (k_touching) have no side to be kept on: they are ignored from then on.
    void detect(const Positions& x, const Positions& displacements, const Margins& margins);

    const std::vector<ContactPair>& pairs() const { return pairs_; }

private:
    struct Surface {
        Triangles triangles;  // in common numbers, as edges and vertices
        Edges edges;
        std::vector<int> vertices;  // those of triangles
        BoxTree vertex_tree, edge_tree, triangle_tree;
    };
    /// Where each vertex may go: along its path from its start, and beside that.
    struct SweptRegion {
        Positions start, path;
        Eigen::VectorXd margins;
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
    /// Of each vertex whether it would leave the region that was searched for it. Then its region is renewed.
    std::vector<char> renew_region(const Positions& x, const Positions& displacements, const Margins& margins);
    template <class Vertices>
    Box box_of(const Vertices& vertices) const;
    template <class VerticesOf>
    void renew_tree(BoxTree& tree, std::size_t count, const std::vector<char>& renewed,
                    const VerticesOf& vertices_of) const;
    void renew_trees(const std::vector<char>& renewed);
    /// All pairs with a renewed vertex anew.
    void search(const std::vector<char>& renewed);
    void find_vertex_faces(const Surface& a, const Surface& b, std::vector<Found>& parts);
    void find_edge_edges(const Surface& a, const Surface& b, std::vector<Found>& parts);
    void add_candidate(Candidate candidate, Found& found);
    std::unordered_set<std::uint64_t>& ignored(PairKind kind) { return ignored_[int(kind)]; }

    int cloth_vertices_, first_layer_vertex_;
    Surface cloth_, obstacle_;
    Margins spare_;
    Margins asked_ { 0, 0 };  // the largest ones so far
    Positions x_;  // of the last detection
    SweptRegion region_;
    bool is_path_empty_ = true;  // there
    std::vector<Candidate> candidates_;  // all pairs that may meet there
    std::array<std::unordered_set<std::uint64_t>, 2> ignored_;  // by kind: pairs of cloth that touched
    std::vector<ContactPair> pairs_;
};

}  // namespace garmentfit
