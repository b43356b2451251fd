// SPDX-License-Identifier: GPL-3.0-or-later
#include "warps.h"

#include <cmath>

#include "surface_measures.h"
#include "tuning.h"

namespace garmentfit {
namespace {

using Vec2 = Eigen::Vector2d;

/// u and v of a triangle on the surface: how places move with each, as shares of the edges from its first corner.
struct ThreadShares {
    Vec2 along_u = Vec2::Zero(), along_v = Vec2::Zero();
    bool is_known = false;
};

/// derived: (s, t) of a place gives (u, v) by the 2 x 2 matrix of the edges in the picture; this is its inverse.
ThreadShares shares_of(const CornerUvs& uvs, Eigen::Index triangle)
{
    const auto corner = [&](int k) { return Vec2(uvs(triangle, 2 * k), uvs(triangle, 2 * k + 1)); };
    Eigen::Matrix2d edges;
    edges << corner(1) - corner(0), corner(2) - corner(0);
    const Eigen::Matrix2d inverse = edges.inverse();
    if (!inverse.allFinite())
        return {};
    return { inverse.col(0), inverse.col(1), true };
}

Vec3 on_surface(const Positions& positions, const Eigen::RowVector3i& corners, const Vec2& shares)
{
    const Vec3 first = positions.row(corners[0]);
    return shares[0] * (positions.row(corners[1]).transpose() - first)
        + shares[1] * (positions.row(corners[2]).transpose() - first);
}

}  // namespace

Warps warps_of(const Positions& positions, const Triangles& triangles, const CornerUvs& uvs)
{
    if (uvs.rows() != triangles.rows())
        return {};
    Warps warps = Warps::Zero(triangles.rows(), 2);
    double known = 0, askew = 0;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        const ThreadShares shares = shares_of(uvs, f);
        const Vec3 u = on_surface(positions, triangles.row(f), shares.along_u),
                   v = on_surface(positions, triangles.row(f), shares.along_v);
        const double lengths = u.norm() * v.norm();
        if (!shares.is_known || !(lengths > 0) || !std::isfinite(lengths))
            continue;
        const double area = area_vector(positions, triangles, f).norm();
        warps.row(f) = shares.along_v / v.norm();
        known += area;
        askew += area * std::abs(u.dot(v)) / lengths;
    }
    return known > 0 && askew <= k_most_askew * known ? warps : Warps();
}

Vec3 warp_direction(const GarmentMesh& garment, Eigen::Index triangle)
{
    return garment.warps.rows() == 0
        ? Vec3::Zero()
        : on_surface(garment.positions, garment.triangles.row(triangle), garment.warps.row(triangle)).normalized();
}

GarmentMesh with_triangles(const GarmentMesh& garment, Positions positions, const std::vector<int>& triangles)
{
    GarmentMesh result { std::move(positions), garment.triangles(triangles, Eigen::all) };
    if (garment.warps.rows() > 0)
        result.warps = garment.warps(triangles, Eigen::all);
    return result;
}

}  // namespace garmentfit
