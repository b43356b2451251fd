// SPDX-License-Identifier: GPL-3.0-or-later
#include "winding_number.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace garmentfit {
namespace {

constexpr int k_leaf_size = 8;
constexpr double k_far = 2;  // radii; beyond, a dipole is good to about one per cent

// Van Oosterom and Strackee 1983.
double solid_angle(const Eigen::Matrix3d& corners, const Vec3& query)
{
    const Vec3 a = corners.col(0) - query, b = corners.col(1) - query, c = corners.col(2) - query;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    const double divisor = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    return 2 * std::atan2(a.dot(b.cross(c)), divisor);
}

Eigen::Matrix3d corners_of(const TriangleMesh& surface, int f)
{
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k)
        corners.col(k) = surface.positions.row(surface.triangles(f, k));
    return corners;
}

Vec3 area_vector_of(const Eigen::Matrix3d& c)
{
    return 0.5 * (c.col(1) - c.col(0)).cross(Vec3(c.col(2) - c.col(0)));
}

int longest_axis(const std::vector<Eigen::Matrix3d>& corners, int begin, int end)
{
    Eigen::AlignedBox3d box;
    for (int i = begin; i < end; ++i)
        box.extend(Vec3(corners[i].rowwise().mean()));
    int axis = 0;
    box.sizes().maxCoeff(&axis);
    return axis;
}

}  // namespace

WindingNumber::WindingNumber(const TriangleMesh& surface)
{
    for (int f = 0; f < surface.triangles.rows(); ++f)
        corners_.push_back(corners_of(surface, f));
    build(0, int(corners_.size()));
}

int WindingNumber::build(int begin, int end)
{
    const int here = int(nodes_.size());
    nodes_.emplace_back();
    Node node;
    node.begin = begin;
    node.end = end;
    double area = 0;
    for (int i = begin; i < end; ++i) {
        const Vec3 a = area_vector_of(corners_[i]);
        node.area_vector += a;
        node.centre += a.norm() * corners_[i].rowwise().mean();
        area += a.norm();
    }
    if (area > 0)
        node.centre /= area;
    for (int i = begin; i < end; ++i)
        node.radius = std::max(node.radius, (corners_[i].colwise() - node.centre).colwise().norm().maxCoeff());
    if (end - begin > k_leaf_size) {
        const int axis = longest_axis(corners_, begin, end), middle = begin + (end - begin) / 2;
        std::nth_element(corners_.begin() + begin, corners_.begin() + middle, corners_.begin() + end,
                         [axis](const auto& a, const auto& b) { return a.row(axis).sum() < b.row(axis).sum(); });
        build(begin, middle);
        node.right = build(middle, end);
    }
    nodes_[here] = node;
    return here;
}

double WindingNumber::operator()(const Vec3& query) const
{
    double angle = 0;
    std::array<int, 64> stack;  // deeper than any tree of 2^31 triangles halved at each level
    int size = 0;
    stack[size++] = 0;
    while (size > 0) {
        const Node& node = nodes_[stack[--size]];
        const Vec3 to = node.centre - query;
        const double distance = to.norm();
        if (distance > k_far * node.radius) {
            angle += node.area_vector.dot(to) / (distance * distance * distance);
        } else if (node.right == 0) {
            for (int i = node.begin; i < node.end; ++i)
                angle += solid_angle(corners_[i], query);
        } else {
            stack[size++] = node.right;
            stack[size++] = int(&node - nodes_.data()) + 1;
        }
    }
    return angle / (4 * std::numbers::pi);
}

double winding_number(const TriangleMesh& surface, const Vec3& query)
{
    double angle = 0;
    for (int f = 0; f < surface.triangles.rows(); ++f)
        angle += solid_angle(corners_of(surface, f), query);
    return angle / (4 * std::numbers::pi);
}

}  // namespace garmentfit
