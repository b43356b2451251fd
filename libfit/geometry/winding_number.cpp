// SPDX-License-Identifier: GPL-3.0-or-later
#include "winding_number.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace garmentfit {
namespace {

constexpr int k_leaf_size = 8;  // unit: decides speed; inside of the last digits also the result
// literature: [barill_2018_fast_winding_numbers], beta = 2, in radii. Beyond, a dipole is good to about 1 %.
constexpr double k_far = 2;

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

Vec3 area_vector_of(const Eigen::Matrix3d& c) { return 0.5 * (c.col(1) - c.col(0)).cross(Vec3(c.col(2) - c.col(0))); }

}  // namespace

WindingNumber::Dipole WindingNumber::dipole_of(std::span<const Triangle> triangles)
{
    Dipole dipole;
    double area = 0;
    for (const Triangle& triangle : triangles) {
        const Vec3 a = area_vector_of(triangle.corners);
        dipole.area_vector += a;
        dipole.centre += a.norm() * triangle.corners.rowwise().mean();
        area += a.norm();
    }
    if (area > 0)
        dipole.centre /= area;
    for (const Triangle& triangle : triangles)
        dipole.radius
            = std::max(dipole.radius, (triangle.corners.colwise() - dipole.centre).colwise().norm().maxCoeff());
    return dipole;
}

WindingNumber::WindingNumber(const TriangleMesh& surface)
{
    std::vector<Triangle> triangles;
    triangles.reserve(std::size_t(surface.triangles.rows()));
    for (int f = 0; f < surface.triangles.rows(); ++f) {
        const Eigen::Matrix3d corners = corners_of(surface, f);
        triangles.push_back({ corners, corners.rowwise().sum() });
    }
    tree_ = { std::move(triangles), k_leaf_size, [](const Triangle& triangle) -> const Vec3& { return triangle.sum; },
              dipole_of };
}

double WindingNumber::operator()(const Vec3& query) const
{
    double angle = 0;
    tree_.walk(
        [&](const Dipole& node) {
            const Vec3 to = node.centre - query;
            const double distance = to.norm();
            if (!(distance > k_far * node.radius))
                return true;
            angle += node.area_vector.dot(to) / (distance * distance * distance);
            return false;
        },
        [&](const Dipole& leaf) {
            for (const Triangle& triangle : tree_.items(leaf))
                angle += solid_angle(triangle.corners, query);
            return true;
        });
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
