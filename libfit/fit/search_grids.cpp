// SPDX-License-Identifier: GPL-3.0-or-later
#include "search_grids.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "posture.h"

namespace garmentfit {
namespace {

constexpr double k_rounding
    = 1e-9;  // unit: of a spacing, and rad; keeps the last line of a grid whose extent is a multiple of its spacing

// Of equal norms, the order is fixed by coordinates.
bool by_norm(const Vec3& a, const Vec3& b)
{
    return std::make_tuple(a.squaredNorm(), a.y(), a.x(), a.z())
        < std::make_tuple(b.squaredNorm(), b.y(), b.x(), b.z());
}

}  // namespace

std::vector<Vec3> grid_offsets(const Vec3& extent, double spacing)
{
    const Eigen::Vector3i n = (extent / spacing + Vec3::Constant(k_rounding)).array().floor().cast<int>();
    std::vector<Vec3> offsets;
    for (int x = -n.x(); x <= n.x(); ++x)
        for (int y = -n.y(); y <= n.y(); ++y)
            for (int z = -n.z(); z <= n.z(); ++z)
                offsets.push_back(spacing * Vec3(x, y, z));
    std::sort(offsets.begin(), offsets.end(), by_norm);
    return offsets;
}

std::vector<Vec3> directions_about(const Vec3& axis, double extent, double spacing)
{
    const Eigen::Quaterniond from_z = shortest_arc(Vec3::UnitZ(), axis);
    std::vector<Vec3> directions { axis };
    for (double phi = spacing; phi <= std::min(extent, std::numbers::pi) + k_rounding; phi += spacing) {
        const int count = std::max(1, int(std::ceil(2 * std::numbers::pi * std::sin(phi) / spacing)));
        for (int i = 0; i < count; ++i) {
            const double theta = 2 * std::numbers::pi * i / count;
            directions.push_back(
                from_z * Vec3(std::sin(phi) * std::cos(theta), std::sin(phi) * std::sin(theta), std::cos(phi)));
        }
    }
    return directions;
}

Eigen::Quaterniond rotation_by(const Vec3& rotation_vector)
{
    const double angle = rotation_vector.norm();
    if (angle == 0)
        return Eigen::Quaterniond::Identity();
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle, rotation_vector / angle));
}

}  // namespace garmentfit
