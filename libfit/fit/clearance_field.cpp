// SPDX-License-Identifier: GPL-3.0-or-later
#include "clearance_field.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "parallel.h"
#include "tuning.h"

namespace garmentfit {
namespace {

constexpr double k_max_nodes = 4e6;  // unit: a limit of memory; a garment far too large gets a coarser grid

}  // namespace

ClearanceField::Parts ClearanceField::parts_of(const TriangleMesh& outward, const TriangleMesh& lids)
{
    std::optional<ClothTree> tree;
    std::optional<CrossingTree> triangles;
    parallel_for<int>(2, [&](int part) {
        if (part == 0)
            triangles.emplace(outward);
        else
            tree.emplace(cloth_patches(outward, k_patch_size), cloth_patches(lids, k_patch_size));
    });
    return { *std::move(tree), *std::move(triangles) };
}

ClearanceField::ClearanceField(const TriangleMesh& outward, const TriangleMesh& lids) :
    ClearanceField(outward, parts_of(outward, lids))
{
}

ClearanceField::ClearanceField(const TriangleMesh& outward, Parts parts) :
    low_(outward.positions.colwise().minCoeff()), high_(outward.positions.colwise().maxCoeff()),
    barycentre_(outward.positions.colwise().mean()), tree_(std::move(parts.tree)),
    triangles_(std::move(parts.triangles))
{
    const Vec3 extent = high_ - low_ + Vec3::Constant(2 * k_grid_border);
    spacing_ = std::max(k_field_spacing, std::cbrt(extent.prod() / k_max_nodes));
    origin_ = low_ - Vec3::Constant(k_grid_border);
    size_ = (extent / spacing_).array().ceil().cast<int>() + 2;
    blocks_ = (size_.array() + ClothTree::k - 1) / ClothTree::k;
    block_ = std::vector<Block>(std::size_t(blocks_.x()) * blocks_.y() * blocks_.z());
    nodes_.resize(std::size_t(size_.x()) * size_.y() * size_.z());
}

void ClearanceField::fill(const Eigen::Vector3i& block) const
{
    constexpr int k = ClothTree::k;
    const Eigen::Vector3i first = k * block, end = (first.array() + k).min(size_.array());
    const ClothTree::Block values = tree_.block(origin_ + spacing_ * first.cast<double>(), spacing_);
    for (int z = first.z(); z < end.z(); ++z)
        for (int y = first.y(); y < end.y(); ++y)
            for (int x = first.x(); x < end.x(); ++x) {
                const int i = ((z - first.z()) * k + y - first.y()) * k + x - first.x();
                nodes_[index({ x, y, z })] = { values.distances[i], float(inside_of(values.windings[i])) };
            }
}

void ClearanceField::require(const Eigen::Vector3i& node) const
{
    const Eigen::Vector3i at = node / ClothTree::k;
    Block& block = block_[(std::size_t(at.z()) * blocks_.y() + at.y()) * blocks_.x() + at.x()];
    if (block.is_filled.load(std::memory_order_acquire))
        return;
    std::call_once(block.once, [&] { fill(at); });
    block.is_filled.store(true, std::memory_order_release);
}

// The cell's eight nodes lie in one block, or in the blocks of its corners.
void ClearanceField::require_cell(const Eigen::Vector3i& cell) const
{
    constexpr int k = ClothTree::k;
    const bool x = cell.x() % k == k - 1, y = cell.y() % k == k - 1, z = cell.z() % k == k - 1;
    for (int corner = 0; corner < 8; ++corner)
        if ((x || !(corner & 1)) && (y || !(corner & 2)) && (z || !(corner & 4)))
            require(cell + Eigen::Vector3i(corner & 1, corner >> 1 & 1, corner >> 2));
}

bool ClearanceField::crosses(const Vec3& from, const Vec3& to) const { return triangles_.is_met(from, to); }

Clearance ClearanceField::at(const Vec3& point) const
{
    const Vec3 last = (size_.array() - 1).cast<double>();
    const Vec3 wanted = (point - origin_) / spacing_;
    const Vec3 cell = wanted.cwiseMax(0).cwiseMin(last);
    const Eigen::Vector3i c = cell.cast<int>().cwiseMin(size_.array().matrix() - Eigen::Vector3i::Constant(2));
    const Eigen::Vector3f t = (cell - c.cast<double>()).cast<float>();
    require_cell(c);
    const std::size_t up = std::size_t(size_.x()) * size_.y(), back = std::size_t(size_.x());
    const Eigen::Vector2f* const node = &nodes_[index(c)];
    const auto along_x = [&](const Eigen::Vector2f* n) { return Eigen::Vector2f(n[0] + t.x() * (n[1] - n[0])); };
    const auto across = [&](const Eigen::Vector2f* n) {
        const Eigen::Vector2f near = along_x(n);
        return Eigen::Vector2f(near + t.y() * (along_x(n + back) - near));
    };
    const Eigen::Vector2f low = across(node), value = low + t.z() * (across(node + up) - low);
    const double beyond = spacing_ * (wanted - cell).norm();  // outside of the grid
    return { value.x() + beyond, beyond > 0 ? 0.0 : double(value.y()) };
}

}  // namespace garmentfit
