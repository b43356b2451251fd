// SPDX-License-Identifier: GPL-3.0-or-later
#include "vertex_tree.h"

namespace garmentfit {
namespace {

constexpr int k_leaf_size = 8;  // unit: decides speed only
constexpr double k_rounding = 1 + 1e-12;  // unit: the vertex that is known has to be found again, whatever rounds

double squared_distance(const FloatBox& box, const Vec3& p)
{
    return (box.min().cast<double>() - p).cwiseMax(p - box.max().cast<double>()).cwiseMax(0).squaredNorm();
}

std::vector<FloatBox> boxes_of(const Positions& vertices)
{
    std::vector<FloatBox> boxes;
    boxes.reserve(std::size_t(vertices.rows()));
    for (Eigen::Index v = 0; v < vertices.rows(); ++v)
        boxes.push_back(box_about(vertices.row(v), vertices.row(v)));
    return boxes;
}

}  // namespace

VertexTree::VertexTree(const Positions& vertices) :
    boxes_(box_hierarchy(boxes_of(vertices), k_leaf_size)), in_order_(vertices.rows(), 3)
{
    for (Eigen::Index i = 0; i < vertices.rows(); ++i)
        in_order_.row(i) = vertices.row(boxes_.items()[i].primitive);
}

int VertexTree::index(const Vec3& query, double known) const
{
    double nearest = known * known * k_rounding;
    int found = 0;
    boxes_.walk_nearest_first([&](const BoxNode& node) { return squared_distance(node.box, query); },
                              [&](double squared) { return squared <= nearest; },
                              [&](const BoxNode& leaf) {
                                  for (int i = leaf.begin; i < leaf.end; ++i) {
                                      const double squared = (Vec3(in_order_.row(i)) - query).squaredNorm();
                                      const int vertex = boxes_.items()[i].primitive;
                                      if (squared < nearest || (squared == nearest && vertex < found)) {
                                          nearest = squared;
                                          found = vertex;
                                      }
                                  }
                              });
    return found;
}

}  // namespace garmentfit
