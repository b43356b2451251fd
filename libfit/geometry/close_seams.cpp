// SPDX-License-Identifier: GPL-3.0-or-later
#include "close_seams.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "disjoint_sets.h"
#include "segment.h"
#include "tuning.h"

namespace garmentfit {
namespace {

/// A vertex of one border and its place along a border edge of another piece.
struct Place {
    int edge = -1;
    double at = 0;  // 0 to 1, from the lower vertex of the edge
    int vertex = -1;

    bool operator<(const Place& other) const
    {
        return std::tie(edge, at, vertex) < std::tie(other.edge, other.at, other.vertex);
    }
};

class SeamClosing {
public:
    SeamClosing(const TriangleMesh& mesh, const MeshTopology& topology) :
        mesh_(mesh), topology_(topology), merged_(int(mesh.positions.rows()))
    {
    }

    void add(const Tie& tie)
    {
        const int edge = border_edge_near(tie);
        if (edge < 0)
            return;
        const auto [low, high] = ends_of(edge);
        const Vec3 along = at(high) - at(low);
        const double length = along.norm(),
                     place = std::clamp((at(tie.vertex) - at(low)).dot(along) / (length * length), 0.0, 1.0);
        const double same = k_same_vertex_share * std::min(length, shortest_border_edge(tie.vertex));
        if (place * length <= same)
            merged_.join(tie.vertex, low);
        else if ((1 - place) * length <= same)
            merged_.join(tie.vertex, high);
        else
            inserted_.push_back({ edge, place, tie.vertex });
    }

    TriangleMesh close() &&
    {
        std::sort(inserted_.begin(), inserted_.end());
        for (const int edge : topology_.border_edges()) {
            const auto [low, high] = ends_of(edge);
            triangle_at_[{ low, high }] = topology_.sides_at(edge)[0] / 3;
        }
        for (const auto& corners : mesh_.triangles.rowwise())
            triangles_.emplace_back(corners);
        for (std::size_t first = 0, next; first < inserted_.size(); first = next) {
            for (next = first; next < inserted_.size() && inserted_[next].edge == inserted_[first].edge; ++next) { }
            insert({ inserted_.begin() + std::ptrdiff_t(first), inserted_.begin() + std::ptrdiff_t(next) });
        }
        TriangleMesh closed { mesh_.positions, Triangles(Eigen::Index(triangles_.size()), 3) };
        for (std::size_t f = 0; f < triangles_.size(); ++f)
            for (int k = 0; k < 3; ++k)
                closed.triangles(Eigen::Index(f), k) = merged_.root(triangles_[f][k]);
        return closed;
    }

private:
    Vec3 at(int v) const { return mesh_.positions.row(v); }
    std::pair<int, int> ends_of(int edge) const { return { topology_.edges()(edge, 0), topology_.edges()(edge, 1) }; }

    /// The border edge that is nearest to a tied vertex, among those at the triangle it is tied to and of pieces that
    /// are not folded back; -1 for none. At a corner two edges are equally near, and the seam is along one of them.
    int border_edge_near(const Tie& tie) const
    {
        constexpr double k_as_near = 1 + 1e-6;  // unit: rounding of two computations of one distance
        std::vector<std::pair<double, int>> edges;
        for (const int corner : tie.corners)
            for (const int other : topology_.neighbours(corner))
                if (const int edge = topology_.edge_between(corner, other);
                    topology_.is_border(edge) && at(corner) != at(other))
                    edges.emplace_back(distance_to_segment(at(tie.vertex), at(corner), at(other)), edge);
        std::sort(edges.begin(), edges.end());
        for (const auto& [distance, edge] : edges)
            if (distance <= k_as_near * edges[0].first && !is_folded_back(tie.vertex, edge))
                return edge;
        return -1;
    }

    double shortest_border_edge(int vertex) const
    {
        double shortest = INFINITY;
        for (const int other : topology_.neighbours(vertex))
            if (topology_.is_border(topology_.edge_between(vertex, other)))
                shortest = std::min(shortest, (at(other) - at(vertex)).norm());
        return shortest;
    }

    bool is_folded_back(int vertex, int edge) const
    {
        const auto [low, high] = ends_of(edge);
        const Vec3 along = (at(high) - at(low)).normalized();
        const auto across = [&](const Vec3& v) { return Vec3((v - v.dot(along) * along).stableNormalized()); };
        Vec3 own = Vec3::Zero();
        for (const int other : topology_.neighbours(vertex))
            own += at(other) - at(vertex);
        const int side = topology_.sides_at(edge)[0];
        const int apex = mesh_.triangles(side / 3, (side % 3 + 2) % 3);
        return across(own).dot(across(at(apex) - at(low))) > k_folded_back;
    }

    /// Splits the triangle at a border edge once for each of these vertices, which lie along the edge in this order.
    void insert(const std::vector<Place>& places)
    {
        auto [low, high] = ends_of(places[0].edge);
        for (const Place& place : places) {
            const int v = place.vertex;
            if (merged_.root(v) == merged_.root(low) || merged_.root(v) == merged_.root(high))
                continue;
            const int f = triangle_at_.at({ std::min(low, high), std::max(low, high) });
            int k = 0;
            while (triangles_[f][k] == low || triangles_[f][k] == high)
                ++k;
            const int apex = triangles_[f][k], rest = int(triangles_.size());
            triangles_.push_back(triangles_[f]);
            std::replace(triangles_[f].begin(), triangles_[f].end(), high, v);
            std::replace(triangles_[rest].begin(), triangles_[rest].end(), low, v);
            if (const auto other = triangle_at_.find(std::minmax(high, apex)); other != triangle_at_.end())
                other->second = rest;
            triangle_at_[{ std::min(v, high), std::max(v, high) }] = rest;
            low = v;
        }
    }

    const TriangleMesh& mesh_;
    const MeshTopology& topology_;
    DisjointSets merged_;
    std::vector<Place> inserted_;
    std::vector<Eigen::RowVector3i> triangles_;
    std::map<std::pair<int, int>, int> triangle_at_;  // of a border edge, by its vertices as they were given
};

}  // namespace

TriangleMesh close_seams(const TriangleMesh& mesh, const MeshTopology& topology, const std::vector<Tie>& ties)
{
    SeamClosing closing(mesh, topology);
    for (const Tie& tie : ties)
        if (tie.is_seam && !tie.is_own)
            closing.add(tie);
    return std::move(closing).close();
}

}  // namespace garmentfit
