// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <mutex>
#include <vector>

#include "clearance.h"
#include "cloth_tree.h"
#include "crossing_tree.h"

namespace garmentfit {

/// The clearance of a garment, interpolated in a grid. Blocks of the grid are computed at the first query, by any
/// thread; later queries take some tens of nanoseconds. Error of the distance within the garment's box: at most the
/// diagonals of a patch and of a cell.
class ClearanceField {
public:
    /// @param outward  from outward_cloth
    /// @param lids  what closes openings, facing outwards: behind it is inside, as behind cloth
    explicit ClearanceField(const TriangleMesh& outward, const TriangleMesh& lids = {});

    Clearance at(const Vec3& point) const;  ///< trilinear
    bool crosses(const Vec3& from, const Vec3& to) const;  ///< by the triangles, exact

    const Vec3& low() const { return low_; }  ///< corners of the garment's box
    const Vec3& high() const { return high_; }
    const Vec3& barycentre() const { return barycentre_; }  ///< of the garment's vertices
    const ClothTree& tree() const { return tree_; }
    const std::vector<ClothPatch>& patches() const { return tree_.patches(); }

private:
    struct Parts {
        ClothTree tree;
        CrossingTree triangles;
    };
    ClearanceField(const TriangleMesh& outward, Parts parts);
    static Parts parts_of(const TriangleMesh& outward, const TriangleMesh& lids);

    /// ClothTree::k nodes along each axis are computed together.
    struct Block {
        std::once_flag once;
        std::atomic<bool> is_filled = false;
    };
    void require_cell(const Eigen::Vector3i& cell) const;
    void require(const Eigen::Vector3i& node) const;
    void fill(const Eigen::Vector3i& block) const;
    std::size_t index(const Eigen::Vector3i& c) const
    {
        return (std::size_t(c.z()) * size_.y() + c.y()) * size_.x() + c.x();
    }

    Vec3 low_, high_, barycentre_;
    ClothTree tree_;
    CrossingTree triangles_;
    Vec3 origin_ = Vec3::Zero();
    double spacing_ = 0;
    Eigen::Vector3i size_ = Eigen::Vector3i::Zero(),
                    blocks_ = Eigen::Vector3i::Zero();  // along each axis: nodes, blocks
    mutable std::vector<Block> block_;
    mutable std::vector<Eigen::Vector2f> nodes_;  // distance (m), inside
};

}  // namespace garmentfit
