// SPDX-License-Identifier: GPL-3.0-or-later
#include "creases.h"

#include <cmath>
#include <numeric>
#include <queue>

#include "fit/mesh.h"
#include "joined_vertices.h"
#include "nearest.h"
#include "parallel.h"
#include "surface_measures.h"

namespace fit {
namespace {

// Layers of cloth need this much room (metres) between two parts of the body.
constexpr double k_clearance = 1e-3;
// Metres; cloth further away from a crease at the start does not get into it on the way.
constexpr double k_reach = 0.15;
// A patch with fewer of the body's vertices than this share is an island in a crease, not a limb beyond it.
constexpr double k_enclosed = 0.01;

/// How far each vertex sees along its normal until it meets the surface again; 0 when it sees it from behind, as it is inside
/// then; infinite when it sees nothing.
std::vector<double> room_above(const TriangleMesh& surface)
{
    const TriangleTree tree(surface);
    const Positions normals = vertex_normals(surface.positions, surface.triangles);
    const double above
        = 1e-6 * (surface.positions.colwise().maxCoeff() - surface.positions.colwise().minCoeff()).norm();
    std::vector<double> result(surface.positions.rows(), INFINITY);
    parallel_for(surface.positions.rows(), [&](Eigen::Index v) {
        const Vec3 n = normals.row(v);
        if (n.isZero())
            return;
        if (const auto hit = tree.first_hit(surface.positions.row(v).transpose() + above * n, n))
            result[v] = hit->from_behind ? 0 : hit->distance;
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

/// Vertices without room, and the sides, so far, of the wedges that open from them.
std::vector<char> creased(const Positions& positions, const std::vector<double>& room,
                          const std::vector<std::vector<int>>& neighbours, double side)
{
    std::vector<double> way(room.size(), INFINITY);  // from the nearest vertex without room; Dijkstra's algorithm
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
    for (std::size_t v = 0; v < room.size(); ++v)
        if (room[v] < k_clearance)
            front.emplace(way[v] = 0, int(v));
    while (!front.empty()) {
        const auto [here, v] = front.top();
        front.pop();
        if (here > way[v])
            continue;
        for (int n : neighbours[v])
            if (const double there = here + (positions.row(v) - positions.row(n)).norm();
                there < std::min(way[n], side))
                front.emplace(way[n] = there, n);
    }
    std::vector<char> result(room.size());
    for (std::size_t v = 0; v < room.size(); ++v)
        result[v] = way[v] < side;
    return result;
}

// Patches of skin that a crease encloses belong to it: left out, they would pin its membrane down inside.
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

// A membrane needs a border: pieces that lie in a crease as a whole (eyeballs, say) are left alone.
void drop_without_border(std::vector<char>& marked, const std::vector<std::vector<int>>& neighbours)
{
    std::vector<char> anchored(marked.size(), 0);
    std::queue<int> front;
    for (std::size_t v = 0; v < marked.size(); ++v)
        if (!marked[v])
            front.push(int(v));
    while (!front.empty()) {
        for (int n : neighbours[front.front()])
            if (marked[n] && !anchored[n]) {
                anchored[n] = 1;
                front.push(n);
            }
        front.pop();
    }
    marked = anchored;
}

// Creases that no cloth will come to stay as they are: mouths and toes would be smoothed away on the way.
void drop_without_cloth(std::vector<char>& marked, const Edges& edges, const std::vector<char>& near)
{
    JoinedVertices creases(int(marked.size()));
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

}  // namespace

Creases::Creases(const TriangleMesh& surface, const std::vector<char>& near_cloth, double side)
{
    const Edges edges = edges_of(surface.triangles);
    const auto neighbours = neighbours_of(edges, std::size_t(surface.positions.rows()));
    std::vector<char> inside
        = creased(surface.positions, room_above(surface), neighbours, side * std::sqrt(area(surface)));
    add_enclosed(inside, neighbours);
    drop_without_border(inside, neighbours);
    drop_without_cloth(inside, edges, near_cloth);

    std::vector<int> row(inside.size(), -1);
    for (std::size_t v = 0; v < inside.size(); ++v)
        if (inside[v]) {
            row[v] = int(inner_.size());
            inner_.push_back(int(v));
        }
    std::vector<Eigen::Triplet<double>> laplacian, border;
    const auto couple = [&](int v, int n) {
        if (row[v] < 0)
            return;
        laplacian.emplace_back(row[v], row[v], 1.0);
        if (row[n] >= 0)
            laplacian.emplace_back(row[v], row[n], -1.0);
        else
            border.emplace_back(row[v], n, 1.0);
    };
    for (Eigen::Index e = 0; e < edges.rows(); ++e) {
        couple(edges(e, 0), edges(e, 1));
        couple(edges(e, 1), edges(e, 0));
    }
    Eigen::SparseMatrix<double> system(inner_.size(), inner_.size());
    system.setFromTriplets(laplacian.begin(), laplacian.end());
    to_border_.resize(inner_.size(), surface.positions.rows());
    to_border_.setFromTriplets(border.begin(), border.end());
    if (!inner_.empty())
        membrane_.compute(system);
}

Positions Creases::bridged(const Positions& positions) const
{
    Positions result = positions;
    if (inner_.empty())
        return result;
    const Eigen::MatrixXd right = to_border_ * positions;
    const Eigen::MatrixXd membrane = membrane_.solve(right);
    for (std::size_t i = 0; i < inner_.size(); ++i)
        result.row(inner_[i]) = membrane.row(i);
    return result;
}

Positions Creases::withdrawn(const Positions& positions, const Positions& core) const
{
    Positions result = positions;
    for (int v : inner_)
        result.row(v) = 0.5 * (core.row(v) + positions.row(v));
    return result;
}

std::vector<char> near_cloth(const Positions& body, const Positions& cloth)
{
    const NearestPoint nearest(cloth);
    std::vector<char> result(body.rows());
    parallel_for(body.rows(), [&](Eigen::Index v) { result[v] = nearest.distance(body.row(v)) < k_reach; });
    return result;
}

}  // namespace fit
