// SPDX-License-Identifier: GPL-3.0-or-later
#include "creases.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include <Eigen/SparseCholesky>

#include "disjoint_sets.h"
#include "garmentfit/mesh.h"
#include "nearest.h"
#include "parallel.h"
#include "surface_measures.h"
#include "topology.h"
#include "tuning.h"

namespace garmentfit {
namespace {

/// Vertices at which a ball of this radius has no clearance above the skin.
std::vector<char> mark_creases(const TriangleMesh& surface, double radius)
{
    const TriangleTree tree(surface);
    const Positions normals = vertex_normals(surface.positions, surface.triangles);
    const double above  // unit: keeps the ray off the triangles that it starts from
        = 1e-6 * (surface.positions.colwise().maxCoeff() - surface.positions.colwise().minCoeff()).norm();
    std::vector<char> result(surface.positions.rows(), 0);
    parallel_for(surface.positions.rows(), [&](Eigen::Index v) {
        const Vec3 p = surface.positions.row(v), n = normals.row(v);
        if (n.isZero())
            return;
        const auto hit = tree.first_hit(p + above * n, n);  // from behind: the vertex is inside another part
        result[v] = (hit && (hit->from_behind || hit->distance < k_ball_tolerance * 2 * radius))
            || tree.distance(p + radius * n) < k_ball_tolerance * radius;
    });
    return result;
}

/// Adds the patches of skin that a crease encloses: left out, they would be part of the boundary, at the bottom of the
/// crease.
void add_enclosed_patches(std::vector<char>& marked, const MeshTopology& topology)
{
    std::vector<char> seen = marked;
    for (std::size_t seed = 0; seed < marked.size(); ++seed) {
        if (seen[seed])
            continue;
        std::vector<int> patch { int(seed) };
        seen[seed] = 1;
        for (std::size_t i = 0; i < patch.size(); ++i)
            for (const int n : topology.neighbours(patch[i]))
                if (!seen[n]) {
                    seen[n] = 1;
                    patch.push_back(n);
                }
        if (patch.size() < k_enclosed_patch * marked.size())
            for (const int v : patch)
                marked[v] = 1;
    }
}

/// Drops creases without cloth near them: mouths and toes would be smoothed away.
void drop_without_cloth(std::vector<char>& marked, const Edges& edges, const std::vector<char>& near_cloth)
{
    DisjointSets creases(int(marked.size()));
    for (Eigen::Index e = 0; e < edges.rows(); ++e)
        if (marked[edges(e, 0)] && marked[edges(e, 1)])
            creases.join(edges(e, 0), edges(e, 1));
    std::vector<char> kept(marked.size(), 0);
    for (std::size_t v = 0; v < marked.size(); ++v)
        if (near_cloth[v])
            kept[creases.root(int(v))] = 1;
    for (std::size_t v = 0; v < marked.size(); ++v)
        marked[v] = marked[v] && kept[creases.root(int(v))];
}

/// Where paths along edges begin, and how long they are by then.
struct PathStart {
    int vertex;
    double length;
};

/// Shortest paths from the boundaries of creases into them.
struct CreasePaths {
    std::vector<double> length;  ///< of each vertex of a crease; infinite for all others, and where no path leads
    std::vector<int> start;  ///< vertex at which the path begins; -1 where no path leads
};

/// By Dijkstra's algorithm, O(n log n).
CreasePaths find_crease_paths(const Positions& positions, const std::vector<char>& marked, const MeshTopology& topology,
                              const std::vector<PathStart>& starts)
{
    CreasePaths result { std::vector<double>(marked.size(), INFINITY), std::vector<int>(marked.size(), -1) };
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
    const auto relax_from = [&](int v, double here, int start) {
        for (const int n : topology.neighbours(v))
            if (const double there = here + (positions.row(v) - positions.row(n)).norm();
                marked[n] && there < result.length[n]) {
                result.start[n] = start;
                front.emplace(result.length[n] = there, n);
            }
    };
    for (const PathStart& start : starts)
        relax_from(start.vertex, start.length, start.vertex);
    while (!front.empty()) {
        const auto [here, v] = front.top();
        front.pop();
        if (here == result.length[v])
            relax_from(v, here, result.start[v]);
    }
    return result;
}

/// Vertices beside those of creases.
std::vector<int> list_boundary(const std::vector<char>& marked, const MeshTopology& topology)
{
    std::vector<int> result;
    for (int v = 0; v < int(marked.size()); ++v) {
        const auto& neighbours = topology.neighbours(v);
        if (!marked[v] && std::any_of(neighbours.begin(), neighbours.end(), [&](int n) { return marked[n]; }))
            result.push_back(v);
    }
    return result;
}

/// How deep a crease is below each vertex of its boundary: half of the longest way through it to the skin across its
/// opening. Measured from vertices k_depth_spacing apart; those between have the depth of one of them. O(b n log n) for
/// b of them.
std::vector<double> find_depths(const Positions& positions, const std::vector<char>& marked,
                                const MeshTopology& topology, const std::vector<int>& boundary, double radius)
{
    std::vector<double> result(boundary.size(), -1);
    for (std::size_t b = 0; b < boundary.size(); ++b) {
        if (result[b] >= 0)
            continue;
        const CreasePaths paths = find_crease_paths(positions, marked, topology, { { boundary[b], 0 } });
        double longest = 0;
        std::vector<std::size_t> near { b };
        for (std::size_t other = 0; other < boundary.size(); ++other) {
            const double across = (positions.row(boundary[b]) - positions.row(boundary[other])).norm();
            if (across > k_opening_width * radius)
                continue;
            double way = INFINITY;
            for (const int n : topology.neighbours(boundary[other]))
                way = std::min(way, paths.length[n] + (positions.row(n) - positions.row(boundary[other])).norm());
            if (way < k_depth_spacing * radius)
                near.push_back(other);
            else if (way < INFINITY)
                longest = std::max(longest, way);
        }
        for (const std::size_t n : near)
            result[n] = longest / 2;
    }
    return result;
}

/// For each vertex of a crease the vertex of its boundary that it is drawn to, or -1: the nearest one along edges, where
/// with BridgeEnds::bottom the way counts from the bottom of the crease up. Between thighs that is the lower end of where they touch, though its
/// front and its back are nearer (docs/decisions/0012-taut-bridges.md). A piece that is crease as a whole (an eyeball,
/// say) has no boundary and is left alone.
std::vector<int> find_ends_of_crease(const Positions& positions, const std::vector<char>& marked,
                                     const MeshTopology& topology, double radius, BridgeEnds ends)
{
    const std::vector<int> boundary = list_boundary(marked, topology);
    const std::vector<double> depths = ends == BridgeEnds::bottom
        ? find_depths(positions, marked, topology, boundary, radius)
        : std::vector<double>(boundary.size(), 0);
    std::vector<PathStart> starts;
    for (std::size_t b = 0; b < boundary.size(); ++b)
        starts.push_back({ boundary[b], -depths[b] });
    return find_crease_paths(positions, marked, topology, starts).start;
}

/// The inner vertices on a soap film over the boundary, m x 3: each in the middle of its neighbours (uniform
/// Laplacian).
Positions solve_soap_film(const Positions& positions, const std::vector<int>& inner, const MeshTopology& topology)
{
    std::vector<int> row(positions.rows(), -1);
    for (std::size_t i = 0; i < inner.size(); ++i)
        row[inner[i]] = int(i);
    std::vector<Eigen::Triplet<double>> laplacian;
    Eigen::MatrixXd boundary = Eigen::MatrixXd::Zero(Eigen::Index(inner.size()), 3);
    for (std::size_t i = 0; i < inner.size(); ++i) {
        laplacian.emplace_back(int(i), int(i), double(topology.neighbours(inner[i]).size()));
        for (const int n : topology.neighbours(inner[i]))
            if (row[n] >= 0)
                laplacian.emplace_back(int(i), row[n], -1.0);
            else
                boundary.row(Eigen::Index(i)) += positions.row(n);
    }
    Eigen::SparseMatrix<double> system(boundary.rows(), boundary.rows());
    system.setFromTriplets(laplacian.begin(), laplacian.end());
    return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(system).solve(boundary);
}

}  // namespace

Creases::Creases(const TriangleMesh& surface, const std::vector<char>& near_cloth, BridgeEnds bridge_ends) :
    surface_(surface.positions), bridged_(surface.positions)
{
    const MeshTopology topology(surface.triangles, int(surface_.rows()));
    const double radius = k_crease_ball * std::sqrt(area(surface));
    std::vector<char> marked = mark_creases(surface, radius);
    add_enclosed_patches(marked, topology);
    drop_without_cloth(marked, topology.edges(), near_cloth);
    const std::vector<int> ends = find_ends_of_crease(surface_, marked, topology, radius, bridge_ends);
    for (std::size_t v = 0; v < ends.size(); ++v)
        if (ends[v] >= 0)
            inner_.push_back(int(v));
    if (inner_.empty())
        return;
    const Positions film = solve_soap_film(surface_, inner_, topology);
    for (std::size_t i = 0; i < inner_.size(); ++i)
        bridged_.row(inner_[i])
            = k_bridge_tautness * surface_.row(ends[inner_[i]]) + (1 - k_bridge_tautness) * film.row(Eigen::Index(i));
}

Positions Creases::withdrawn_surface(const Positions& core) const
{
    Positions result = surface_;
    for (const int v : inner_)
        result.row(v) = k_crease_withdrawal * core.row(v) + (1 - k_crease_withdrawal) * surface_.row(v);
    return result;
}

std::vector<char> mark_near_cloth(const Positions& body, const Positions& cloth)
{
    const NearestPoint nearest(cloth);
    std::vector<char> result(body.rows());
    parallel_for(body.rows(), [&](Eigen::Index v) { result[v] = nearest.distance(body.row(v)) < k_crease_reach; });
    return result;
}

}  // namespace garmentfit
