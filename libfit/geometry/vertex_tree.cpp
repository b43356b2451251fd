// SPDX-License-Identifier: GPL-3.0-or-later
#include "vertex_tree.h"

#include <array>
#include <utility>

namespace garmentfit {
namespace {

constexpr int k_leaf_size = 8;
constexpr double k_rounding = 1 + 1e-12;  // the vertex that is known has to be found again

double squared_distance(const BoxHierarchy::Box& box, const Vec3& p)
{
    return (box.min().cast<double>() - p).cwiseMax(p - box.max().cast<double>()).cwiseMax(0).squaredNorm();
}

std::vector<BoxHierarchy::Box> boxes_of(const Positions& vertices)
{
    std::vector<BoxHierarchy::Box> boxes;
    boxes.reserve(std::size_t(vertices.rows()));
    for (Eigen::Index v = 0; v < vertices.rows(); ++v)
        boxes.push_back(box_about(vertices.row(v), vertices.row(v)));
    return boxes;
}

}  // namespace

VertexTree::VertexTree(const Positions& vertices) :
    boxes_(boxes_of(vertices), k_leaf_size), in_order_(vertices(boxes_.order(), Eigen::all))
{
}

int VertexTree::index(const Vec3& query, double known) const
{
    const std::vector<BoxHierarchy::Node>& nodes = boxes_.nodes();
    double nearest = known * known * k_rounding;
    int found = 0;
    std::array<std::pair<double, int>, BoxHierarchy::k_deepest> stack;  // squared distances, nodes
    int size = 0;
    const auto push = [&](double squared, int node) {
        if (squared <= nearest)
            stack[size++] = { squared, node };
    };
    push(0, 0);
    while (size > 0) {
        const auto [squared, n] = stack[--size];
        const BoxHierarchy::Node& node = nodes[n];
        if (squared > nearest)
            continue;
        if (node.right != 0) {
            const double left = squared_distance(nodes[n + 1].box, query),
                         right = squared_distance(nodes[node.right].box, query);
            push(std::max(left, right), left > right ? n + 1 : node.right);
            push(std::min(left, right), left > right ? node.right : n + 1);
            continue;
        }
        for (int i = node.begin; i < node.end; ++i) {
            const double to_vertex = (Vec3(in_order_.row(i)) - query).squaredNorm();
            const int vertex = boxes_.order()[i];
            if (to_vertex < nearest || (to_vertex == nearest && vertex < found)) {
                nearest = to_vertex;
                found = vertex;
            }
        }
    }
    return found;
}

}  // namespace garmentfit
