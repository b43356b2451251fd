// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloth_room.h"

#include <algorithm>
#include <cmath>

namespace fit {
namespace {

constexpr double k_patch = 0.015;  // m; a third of the narrowest cuff's radius
constexpr double k_grid_spacing = 0.02;  // m; half of it
constexpr double k_border = 0.04;  // m; round the garment's box; beyond, everything is outside
constexpr double k_largest_grid = 4e6;  // nodes; a garment far too large gets a coarser grid, not more memory

}  // namespace

ClothRoom::ClothRoom(const TriangleMesh& outward) :
    low_(outward.positions.colwise().minCoeff()), high_(outward.positions.colwise().maxCoeff()),
    barycentre_(outward.positions.colwise().mean()), tree_(cloth_patches(outward, k_patch)), triangles_(outward)
{
    const Vec3 extent = high_ - low_ + Vec3::Constant(2 * k_border);
    spacing_ = std::max(k_grid_spacing, std::cbrt(extent.prod() / k_largest_grid));
    origin_ = low_ - Vec3::Constant(k_border);
    size_ = (extent / spacing_).array().ceil().cast<int>() + 2;
    blocks_ = (size_.array() + ClothTree::k - 1) / ClothTree::k;
    block_ = std::vector<Block>(std::size_t(blocks_.x()) * blocks_.y() * blocks_.z());
}

Eigen::Vector2f ClothRoom::node(int x, int y, int z) const
{
    constexpr int k = ClothTree::k;
    Block& block = block_[(std::size_t(z / k) * blocks_.y() + y / k) * blocks_.x() + x / k];
    std::call_once(block.filled, [&] {
        block.values = tree_.block(origin_ + spacing_ * k * Vec3(x / k, y / k, z / k), spacing_);
        block.values.windings
            = block.values.windings.unaryExpr([](float winding) { return float(inside_of(winding)); });
    });
    const int i = (z % k * k + y % k) * k + x % k;
    return { block.values.distances[i], block.values.windings[i] };
}

bool ClothRoom::crosses(const Vec3& from, const Vec3& to) const { return triangles_.is_met(from, to); }

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
        value += weight * node(c.x() + dx, c.y() + dy, c.z() + dz);
    }
    const double beyond = spacing_ * (wanted - cell).norm();  // outside of the grid
    return { value.x() + beyond, beyond > 0 ? 0.0 : double(value.y()) };
}

}  // namespace fit
