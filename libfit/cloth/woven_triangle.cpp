// SPDX-License-Identifier: GPL-3.0-or-later
#include "woven_triangle.h"

#include <cmath>

#include <Eigen/LU>

#include "materials.h"
#include "warps.h"

namespace garmentfit {
namespace {

// unit: sine of the least angle, 10 degrees. The stiffness of the sides grows with the square of its cotangent.
constexpr double k_thinnest = 0.17;
// unit: the geometric mean of both of Poisson's ratios; that of an even net of springs, as of cloth without a warp.
constexpr double k_poisson = 1. / 3;

/// Plane stress by strain along the warp, along the weft, and by shear angle, N/m.
Eigen::Matrix3d stress_of_strain(const Material& material)
{
    const double warp = stiffness_along_warp(material), weft = stiffness_along_weft(material),
                 both = 1 - k_poisson * k_poisson;
    Eigen::Matrix3d result = Eigen::Matrix3d::Zero();
    result(0, 0) = warp / both;
    result(1, 1) = weft / both;
    result(0, 1) = result(1, 0) = k_poisson * std::sqrt(warp * weft) / both;
    result(2, 2) = material.shear_stiffness;
    return result;
}

bool is_thin(const Eigen::Vector3d& lengths, double area)
{
    for (int k = 0; k < 3; ++k)  // the angle between two sides
        if (!(2 * area > k_thinnest * lengths[k] * lengths[(k + 1) % 3]))
            return true;
    return false;
}

}  // namespace

std::optional<Eigen::Matrix3d> woven_triangle(const GarmentMesh& rest, Eigen::Index triangle, const Material& material)
{
    const Vec3 warp = warp_direction(rest, triangle);
    if (warp.isZero())
        return {};
    const auto corner = [&](int k) { return Vec3(rest.positions.row(rest.triangles(triangle, k))); };
    const Vec3 sides[] = { corner(1) - corner(0), corner(2) - corner(1), corner(0) - corner(2) };
    const Eigen::Vector3d lengths(sides[0].norm(), sides[1].norm(), sides[2].norm());
    const Vec3 normal = sides[0].cross(sides[1]);
    const double area = 0.5 * normal.norm();
    if (is_thin(lengths, area))
        return {};
    const Vec3 weft = normal.normalized().cross(warp);
    Eigen::Matrix3d lengthening;  // of the sides, by the strain
    for (int k = 0; k < 3; ++k) {
        const double along = sides[k].dot(warp) / lengths[k], across = sides[k].dot(weft) / lengths[k];
        lengthening.row(k) = lengths[k] * Eigen::RowVector3d(along * along, across * across, along * across);
    }
    const Eigen::Matrix3d strain = lengthening.inverse();
    return Eigen::Matrix3d(area * strain.transpose() * stress_of_strain(material) * strain);
}

}  // namespace garmentfit
