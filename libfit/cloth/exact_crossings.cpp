// SPDX-License-Identifier: GPL-3.0-or-later
#include "exact_crossings.h"

#include <algorithm>

#include "parallel.h"
#include "part_of_mesh.h"
#include "segment_triangle.h"

namespace garmentfit {
namespace {

// Vertices at one place count as one vertex: seams of UV charts have two.
bool is_corner(const Positions& positions, const Triangles& triangles, int triangle, const Eigen::RowVector3d& place)
{
    const auto corners = triangles.row(triangle);
    return positions.row(corners[0]) == place || positions.row(corners[1]) == place
        || positions.row(corners[2]) == place;
}

// Of each vertex whether it is elsewhere than it was; all where nothing is known of that.
std::vector<char> find_moved(const Positions& before, const Positions& now)
{
    std::vector<char> is_moved(now.rows(), 1);
    if (before.rows() == now.rows())
        for (Eigen::Index v = 0; v < now.rows(); ++v)
            is_moved[v] = before.row(v) != now.row(v);
    return is_moved;
}

template <class Corners>
void renew_tree(BoxTree& tree, const Corners& corners, const Positions& positions, const std::vector<char>& is_moved)
{
    const auto box_of = [&](Eigen::Index i) {
        Box box;
        for (const int v : corners.row(i))
            box.extend(Vec3(positions.row(v)));
        return box;
    };
    tree.renew_or_build(
        corners.rows(), [&](int i) { return has_marked(corners.row(i), is_moved); }, box_of);
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
        return is_corner(mesh.positions, mesh.triangles, triangle, mesh.positions.row(edges(e, 0)))
            || is_corner(mesh.positions, mesh.triangles, triangle, mesh.positions.row(edges(e, 1)));
    });
}

bool SelfCrossingSearch::cross(const Positions& positions, int edge, int triangle) const
{
    const auto corners = triangles_.row(triangle);
    const auto at = [&](int v) { return Vec3(positions.row(v)); };
    for (const int v : edges_.row(edge))
        if (is_corner(positions, triangles_, triangle, positions.row(v)))
            return false;
    return meets(at(edges_(edge, 0)), at(edges_(edge, 1)), at(corners[0]), at(corners[1]), at(corners[2]));
}

std::vector<Crossing> SelfCrossingSearch::find(const Positions& positions)
{
    const std::vector<char> is_moved = find_moved(positions_, positions);
    renew_tree(edge_tree_, edges_, positions, is_moved);
    renew_tree(triangle_tree_, triangles_, positions, is_moved);
    std::erase_if(crossings_, [&](const Crossing& crossing) {
        return has_marked(edges_.row(crossing.first), is_moved)
            || has_marked(triangles_.row(crossing.second), is_moved);
    });
    std::vector<std::vector<Crossing>> parts(BoxTree::k_parts);
    BoxTree::overlaps(edge_tree_, triangle_tree_, [&](int part, int edge, int triangle) {
        if (cross(positions, edge, triangle))
            parts[part].emplace_back(edge, triangle);
    });
    for (const std::vector<Crossing>& part : parts)
        crossings_.insert(crossings_.end(), part.begin(), part.end());
    std::sort(crossings_.begin(), crossings_.end());
    positions_ = positions;
    return crossings_;
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
    const TriangleMesh of_a = part_in(a, box_of(b.positions)), of_b = part_in(b, box_of(a.positions));
    return int(crossings(of_a, of_b).size() + crossings(of_b, of_a).size());
}

}  // namespace garmentfit
