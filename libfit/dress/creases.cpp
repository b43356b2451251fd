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

namespace garmentfit {
namespace {

// Of the ball that needs room above the skin, in square roots of the body's area, which no pose changes: 1 cm for an adult. Larger
// balls fill laps and crotches further than they have to.
constexpr double k_ball = 0.0075;
constexpr double k_fits = 0.9;  // skin is not smooth: a ball that has so much of its room does fit
// A bridge is drawn so tight between the lips of its crease; the rest is left to a soap film, that no face loses its area.
constexpr double k_tight = 0.9;
// Metres; cloth further away from a crease at the start does not get into it on the way.
constexpr double k_reach = 0.15;
// A patch with fewer of the body's vertices than this share is an island in a crease, not a limb beyond it.
constexpr double k_enclosed = 0.01;

/// Vertices at which a ball has no room.
std::vector<char> cramped(const TriangleMesh& surface)
{
    const TriangleTree tree(surface);
    const Positions normals = vertex_normals(surface.positions, surface.triangles);
    const double radius = k_ball * std::sqrt(area(surface));
    const double above
        = 1e-6 * (surface.positions.colwise().maxCoeff() - surface.positions.colwise().minCoeff()).norm();
    std::vector<char> result(surface.positions.rows(), 0);
    parallel_for(surface.positions.rows(), [&](Eigen::Index v) {
        const Vec3 p = surface.positions.row(v), n = normals.row(v);
        if (n.isZero())
            return;
        const auto hit = tree.first_hit(p + above * n, n);  // from behind when the vertex is inside another part
        result[v] = (hit && (hit->from_behind || hit->distance < k_fits * 2 * radius))
            || tree.distance(p + radius * n) < k_fits * radius;
    });
    return result;
}

using Edges = Eigen::Matrix<int, Eigen::Dynamic, 2, Eigen::RowMajor>;

std::vector<std::vector<int>> neighbours_of(const Edges& edges, std::size_t vertices)
{
    std::vector<std::vector<int>> neighbours(vertices);
    for (Eigen::Index e = 0; e < edges.rows(); ++e) {
        neighbours[edges(e, 0)].push_back(edges(e, 1));
        neighbours[edges(e, 1)].push_back(edges(e, 0));
    }
    return neighbours;
}

// Patches of skin that a crease encloses belong to it: left out, they would be lips at its bottom.
void add_enclosed(std::vector<char>& marked, const std::vector<std::vector<int>>& neighbours)
{
    std::vector<char> seen = marked;
    for (std::size_t seed = 0; seed < marked.size(); ++seed) {
        if (seen[seed])
            continue;
        std::vector<int> patch { int(seed) };
        seen[seed] = 1;
        for (std::size_t i = 0; i < patch.size(); ++i)
            for (int n : neighbours[patch[i]])
                if (!seen[n]) {
                    seen[n] = 1;
                    patch.push_back(n);
                }
        if (patch.size() < k_enclosed * marked.size())
            for (int v : patch)
                marked[v] = 1;
    }
}

// Creases that no cloth will come to stay as they are: mouths and toes would be smoothed away on the way.
void drop_without_cloth(std::vector<char>& marked, const Edges& edges, const std::vector<char>& near)
{
    DisjointSets creases(int(marked.size()));
    for (Eigen::Index e = 0; e < edges.rows(); ++e)
        if (marked[edges(e, 0)] && marked[edges(e, 1)])
            creases.join(edges(e, 0), edges(e, 1));
    std::vector<char> kept(marked.size(), 0);
    for (std::size_t v = 0; v < marked.size(); ++v)
        if (near[v])
            kept[creases.root(int(v))] = 1;
    for (std::size_t v = 0; v < marked.size(); ++v)
        marked[v] = marked[v] && kept[creases.root(int(v))];
}

/// Of each vertex of a crease the nearest one on its lips, along edges, by Dijkstra's algorithm; -1 for all others. Pieces that lie in a
/// crease as a whole (eyeballs, say) have no lips, and are left alone.
std::vector<int> nearest_lips(const Positions& positions, const std::vector<char>& marked,
                              const std::vector<std::vector<int>>& neighbours)
{
    std::vector<int> lips(marked.size(), -1);
    std::vector<double> way(marked.size(), INFINITY);
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
    const auto look_from = [&](int v, double here, int lip) {
        for (int n : neighbours[v])
            if (const double there = here + (positions.row(v) - positions.row(n)).norm(); marked[n] && there < way[n]) {
                lips[n] = lip;
                front.emplace(way[n] = there, n);
            }
    };
    for (std::size_t v = 0; v < marked.size(); ++v)
        if (!marked[v])
            look_from(int(v), 0, int(v));
    while (!front.empty()) {
        const auto [here, v] = front.top();
        front.pop();
        if (here == way[v])
            look_from(v, here, lips[v]);
    }
    return lips;
}

/// Where a soap film over the lips has the inner vertices, m x 3: each in the middle of its neighbours.
Positions soap_film(const Positions& positions, const std::vector<int>& inner,
                    const std::vector<std::vector<int>>& neighbours)
{
    std::vector<int> row(neighbours.size(), -1);
    for (std::size_t i = 0; i < inner.size(); ++i)
        row[inner[i]] = int(i);
    std::vector<Eigen::Triplet<double>> laplacian;
    Eigen::MatrixXd lips = Eigen::MatrixXd::Zero(Eigen::Index(inner.size()), 3);
    for (std::size_t i = 0; i < inner.size(); ++i) {
        laplacian.emplace_back(int(i), int(i), double(neighbours[inner[i]].size()));
        for (int n : neighbours[inner[i]])
            if (row[n] >= 0)
                laplacian.emplace_back(int(i), row[n], -1.0);
            else
                lips.row(Eigen::Index(i)) += positions.row(n);
    }
    Eigen::SparseMatrix<double> system(lips.rows(), lips.rows());
    system.setFromTriplets(laplacian.begin(), laplacian.end());
    return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(system).solve(lips);
}

}  // namespace

Creases::Creases(const TriangleMesh& surface, const std::vector<char>& near_cloth) :
    surface_(surface.positions), bridged_(surface.positions)
{
    const Edges edges = edges_of(surface.triangles);
    const auto neighbours = neighbours_of(edges, std::size_t(surface_.rows()));
    std::vector<char> marked = cramped(surface);
    add_enclosed(marked, neighbours);
    drop_without_cloth(marked, edges, near_cloth);
    const std::vector<int> lips = nearest_lips(surface_, marked, neighbours);
    for (std::size_t v = 0; v < lips.size(); ++v)
        if (lips[v] >= 0)
            inner_.push_back(int(v));
    if (inner_.empty())
        return;
    const Positions film = soap_film(surface_, inner_, neighbours);
    for (std::size_t i = 0; i < inner_.size(); ++i)
        bridged_.row(inner_[i]) = k_tight * surface_.row(lips[inner_[i]]) + (1 - k_tight) * film.row(Eigen::Index(i));
}

Positions Creases::withdrawn(const Positions& core) const
{
    Positions result = surface_;
    for (int v : inner_)
        result.row(v) = 0.5 * (core.row(v) + surface_.row(v));
    return result;
}

std::vector<char> near_cloth(const Positions& body, const Positions& cloth)
{
    const NearestPoint nearest(cloth);
    std::vector<char> result(body.rows());
    parallel_for(body.rows(), [&](Eigen::Index v) { result[v] = nearest.distance(body.row(v)) < k_reach; });
    return result;
}

}  // namespace garmentfit
