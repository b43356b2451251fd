// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Edges, neighbours and borders of a triangle mesh: built once, handed down to all who ask.
//
// A side is the directed edge of a triangle from its corner k to its corner k + 1 (mod 3); its number is 3 f + k. An
// edge is an undirected pair of vertices; several sides may lie on it: one on a border, two on a manifold, more where
// sheets meet. A side between a vertex and itself lies on no edge.
//
// Cost  O(n) memory and, for meshes whose vertices have a bounded number of triangles, O(n) time.

#include <algorithm>
#include <span>
#include <vector>

#include "garmentfit/mesh.h"

namespace garmentfit {

using Edges = Eigen::Matrix<int, Eigen::Dynamic, 2, Eigen::RowMajor>;  ///< rows (i, j), i < j

class MeshTopology {
public:
    MeshTopology() = default;
    /// @param vertices  at least one more than the largest index in `triangles`
    MeshTopology(const Triangles& triangles, int vertices);

    /// Each edge once, sorted: the rows of edges_of().
    const Edges& edges() const { return edges_; }
    /// The edge between two vertices, or -1.
    int edge_between(int a, int b) const;

    /// The edge that a side lies on, or -1.
    int edge_of(int side) const { return edge_of_side_[side]; }
    /// All sides on an edge, ascending.
    std::span<const int> sides_at(int edge) const { return range(sides_, first_side_, edge); }
    /// The other side on the same edge; -1 where there is none or more than one.
    int opposite(int side) const;

    /// Vertices that share an edge with this one, ascending.
    std::span<const int> neighbours(int vertex) const { return range(neighbours_, first_neighbour_, vertex); }

    /// Whether one triangle alone lies at the edge.
    bool is_border(int edge) const { return first_side_[edge + 1] - first_side_[edge] == 1; }
    std::vector<int> border_edges() const;
    /// Borders in the direction of their triangles, each as its vertices in turn, begun at the border edge with the
    /// smallest number. Where several borders meet in a vertex, each goes on along the first side left.
    std::vector<std::vector<int>> border_loops() const;

private:
    static std::span<const int> range(const std::vector<int>& items, const std::vector<int>& first, int key)
    {
        return { items.data() + first[key], std::size_t(first[key + 1] - first[key]) };
    }
    int from(int side) const { return triangles_(side / 3, side % 3); }
    int to(int side) const { return triangles_(side / 3, (side % 3 + 1) % 3); }
    void collect_edges(int vertices);
    void collect_neighbours(int vertices);

    Triangles triangles_;
    Edges edges_;
    std::vector<int> edge_of_side_;
    std::vector<int> sides_, first_side_;  // by edge
    std::vector<int> first_edge_;  // by lower vertex
    std::vector<int> neighbours_, first_neighbour_;  // by vertex
};

/// m, of the edges; 0 for none. Summed in the order of the edges.
double mean_edge_length(const Positions& positions, const Edges& edges);

/// Adds to each row of `sums` the rows of `values` at the vertex's neighbours, in the order of the edges: one step of
/// Laplacian smoothing is this, with weights of the caller's.
template <class Values>
void add_neighbours(const Edges& edges, const Values& values, Values& sums)
{
    for (Eigen::Index e = 0; e < edges.rows(); ++e) {
        sums.row(edges(e, 0)) += values.row(edges(e, 1));
        sums.row(edges(e, 1)) += values.row(edges(e, 0));
    }
}

/// How many edges each vertex has, as numbers to divide by.
Eigen::VectorXd edge_counts(const Edges& edges, Eigen::Index vertices);

}  // namespace garmentfit
