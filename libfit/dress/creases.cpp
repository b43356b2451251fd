// SPDX-License-Identifier: GPL-3.0-or-later
#include "creases.h"

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

/// Vertices at which a ball has no clearance above the skin.
std::vector<char> mark_creases(const TriangleMesh& surface)
{
    const TriangleTree tree(surface);
    const Positions normals = vertex_normals(surface.positions, surface.triangles);
    const double radius = k_crease_ball * std::sqrt(area(surface));
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

/// For each vertex of a crease the nearest vertex of its boundary, along edges, by Dijkstra's algorithm; -1 for all
/// others. A piece that is crease as a whole (an eyeball, say) has no boundary and is left alone.
std::vector<int> find_nearest_boundary(const Positions& positions, const std::vector<char>& marked,
                                       const MeshTopology& topology)
{
    std::vector<int> boundary(marked.size(), -1);
    std::vector<double> distance(marked.size(), INFINITY);
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
    const auto relax_from = [&](int v, double here, int source) {
        for (const int n : topology.neighbours(v))
            if (const double there = here + (positions.row(v) - positions.row(n)).norm();
                marked[n] && there < distance[n]) {
                boundary[n] = source;
                front.emplace(distance[n] = there, n);
            }
    };
    for (std::size_t v = 0; v < marked.size(); ++v)
        if (!marked[v])
            relax_from(int(v), 0, int(v));
    while (!front.empty()) {
        const auto [here, v] = front.top();
        front.pop();
        if (here == distance[v])
            relax_from(v, here, boundary[v]);
    }
    return boundary;
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

Creases::Creases(const TriangleMesh& surface, const std::vector<char>& near_cloth) :
    surface_(surface.positions), bridged_(surface.positions)
{
    const MeshTopology topology(surface.triangles, int(surface_.rows()));
    std::vector<char> marked = mark_creases(surface);
    add_enclosed_patches(marked, topology);
    drop_without_cloth(marked, topology.edges(), near_cloth);
    const std::vector<int> boundary = find_nearest_boundary(surface_, marked, topology);
    for (std::size_t v = 0; v < boundary.size(); ++v)
        if (boundary[v] >= 0)
            inner_.push_back(int(v));
    if (inner_.empty())
        return;
    const Positions film = solve_soap_film(surface_, inner_, topology);
    for (std::size_t i = 0; i < inner_.size(); ++i)
        bridged_.row(inner_[i]) = k_bridge_tautness * surface_.row(boundary[inner_[i]])
            + (1 - k_bridge_tautness) * film.row(Eigen::Index(i));
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
