// SPDX-License-Identifier: GPL-3.0-or-later
#include "exact_crossings.h"

#include "parallel.h"

namespace garmentfit {
namespace {

// Vertices at one place count as one vertex: seams of UV charts have two.
bool is_corner(const TriangleMesh& mesh, int triangle, const Eigen::RowVector3d& place)
{
    const auto corners = mesh.triangles.row(triangle);
    return mesh.positions.row(corners[0]) == place || mesh.positions.row(corners[1]) == place
        || mesh.positions.row(corners[2]) == place;
}

// @param is_left_out  (edge, triangle) -> bool
template <class IsLeftOut>
std::vector<Crossing> find(const TriangleMesh& a, const Edges& edges, const TriangleTree& tree,
                           const IsLeftOut& is_left_out)
{
    std::vector<std::vector<int>> hits(edges.rows());
    parallel_for(edges.rows(), [&](Eigen::Index e) {
        hits[e] = tree.met_by(a.positions.row(edges(e, 0)), a.positions.row(edges(e, 1)),
                              [&](int triangle) { return is_left_out(e, triangle); });
    });
    std::vector<Crossing> result;
    for (Eigen::Index e = 0; e < edges.rows(); ++e)
        for (int f : hits[e])
            result.emplace_back(int(e), f);
    return result;
}

}  // namespace

std::vector<Crossing> find_crossings(const TriangleMesh& a, const Edges& edges_of_a, const TriangleTree& tree_of_b)
{
    return find(a, edges_of_a, tree_of_b, [](Eigen::Index, int) { return false; });
}

std::vector<Crossing> find_self_crossings(const TriangleMesh& mesh, const Edges& edges, const TriangleTree& tree)
{
    return find(mesh, edges, tree, [&](Eigen::Index e, int triangle) {
        return is_corner(mesh, triangle, mesh.positions.row(edges(e, 0)))
            || is_corner(mesh, triangle, mesh.positions.row(edges(e, 1)));
    });
}

std::vector<Crossing> crossings(const TriangleMesh& a, const TriangleMesh& b)
{
    return find_crossings(a, edges_of(a.triangles), TriangleTree(b));
}

std::vector<Crossing> self_crossings(const TriangleMesh& mesh)
{
    return find_self_crossings(mesh, edges_of(mesh.triangles), TriangleTree(mesh));
}

int crossing_count(const TriangleMesh& a, const TriangleMesh& b)
{
    return int(crossings(a, b).size() + crossings(b, a).size());
}

}  // namespace garmentfit
