// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloth_room.h"

#include <algorithm>
#include <cmath>

#include "parallel.h"

namespace fit {
namespace {

constexpr double k_point_spacing = 0.015;  // m; a third of the narrowest cuff's radius
constexpr double k_grid_spacing = 0.02;    // m; half of it
constexpr double k_border = 0.1;           // m; round the garment's box; beyond, everything is outside
constexpr double k_largest_grid = 4e5;     // nodes; a garment far too large gets a coarser grid, not a slow one

// Winding numbers: about 0.5 in the plane of an opening, 0.25 a radius outside of it, about 0 behind cloth.
constexpr double k_surely_outside = 0.25, k_surely_inside = 0.45;

double inside_of(double winding)
{
    return std::clamp((winding - k_surely_outside) / (k_surely_inside - k_surely_outside), 0.0, 1.0);
}

// Vertices, and points between them on triangles that are large: a nearest vertex says little about a wide triangle.
Positions points_on(const TriangleMesh& cloth)
{
    std::vector<Vec3> points;
    std::vector<bool> used(cloth.positions.rows(), false);
    for (Eigen::Index f = 0; f < cloth.triangles.rows(); ++f) {
        Vec3 corner[3];
        for (int k = 0; k < 3; ++k) {
            corner[k] = cloth.positions.row(cloth.triangles(f, k));
            if (!used[cloth.triangles(f, k)])
                points.push_back(corner[k]);
            used[cloth.triangles(f, k)] = true;
        }
        const double longest = std::max({ (corner[0] - corner[1]).norm(), (corner[1] - corner[2]).norm(),
                                          (corner[2] - corner[0]).norm() });
        const int parts = int(std::min(std::ceil(longest / k_point_spacing), 40.0));
        for (int i = 0; i <= parts && parts > 1; ++i)
            for (int j = 0; i + j <= parts; ++j)
                if (i < parts && j < parts && i + j > 0)
                    points.push_back((i * corner[0] + j * corner[1] + (parts - i - j) * corner[2]) / parts);
    }
    Positions rows(points.size(), 3);
    for (std::size_t i = 0; i < points.size(); ++i)
        rows.row(i) = points[i];
    return rows;
}

}  // namespace

ClothRoom::ClothRoom(const TriangleMesh& outward, const Progress& progress)
    : low_(outward.positions.colwise().minCoeff())
    , high_(outward.positions.colwise().maxCoeff())
    , points_(points_on(outward))
    , nearest_(points_)
    , winding_(outward)
    , crossings_(outward)
{
    fill(progress);
}

void ClothRoom::fill(const Progress& progress)
{
    const Vec3 extent = high_ - low_ + Vec3::Constant(2 * k_border);
    spacing_ = std::max(k_grid_spacing, std::cbrt(extent.prod() / k_largest_grid));
    origin_ = low_ - Vec3::Constant(k_border);
    size_ = (extent / spacing_).array().ceil().cast<int>() + 2;
    nodes_.resize(std::size_t(size_.x()) * size_.y() * size_.z());
    for (int z = 0; z < size_.z(); ++z) {
        progress.at(double(z) / size_.z());
        parallel_for(size_.y(), [&](int y) {
            for (int x = 0; x < size_.x(); ++x) {
                const Room room = exact(origin_ + spacing_ * Vec3(x, y, z));
                nodes_[node(x, y, z)] = { float(room.distance), float(room.inside) };
            }
        });
    }
}

Room ClothRoom::exact(const Vec3& point) const { return { nearest_.distance(point), inside_of(winding_(point)) }; }

Room ClothRoom::at(const Vec3& point) const
{
    const Vec3 last = (size_.array() - 1).cast<double>();
    const Vec3 wanted = (point - origin_) / spacing_;
    const Vec3 cell = wanted.cwiseMax(0).cwiseMin(last);
    const Eigen::Vector3i c = cell.cast<int>().cwiseMin(size_.array().matrix() - Eigen::Vector3i::Constant(2));
    const Eigen::Vector3f t = (cell - c.cast<double>()).cast<float>();
    Eigen::Vector2f value = Eigen::Vector2f::Zero();
    for (int corner = 0; corner < 8; ++corner) {
        const int dx = corner & 1, dy = corner >> 1 & 1, dz = corner >> 2;
        const float weight = (dx ? t.x() : 1 - t.x()) * (dy ? t.y() : 1 - t.y()) * (dz ? t.z() : 1 - t.z());
        value += weight * nodes_[node(c.x() + dx, c.y() + dy, c.z() + dz)];
    }
    const double beyond = spacing_ * (wanted - cell).norm();  // outside of the grid
    return { value.x() + beyond, beyond > 0 ? 0.0 : double(value.y()) };
}

}  // namespace fit
