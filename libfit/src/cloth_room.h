// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "fit/progress.h"
#include "nearest.h"
#include "winding_number.h"

namespace fit {

/// What a garment offers to a point: how far the cloth is, and how surely the point is inside.
struct Room {
    double distance = 0;  ///< m, to the nearest cloth
    double inside = 0;    ///< 1 inside, 0 outside, between the two on the way through an opening
};

/// Answers from a grid (some tens of nanoseconds, good to a fraction of its spacing) or from the cloth itself.
/// Cost: one nearest point and one winding number for each node of the grid.
class ClothRoom {
public:
    /// @param outward  from outward_cloth
    ClothRoom(const TriangleMesh& outward, const Progress& progress);

    Room at(const Vec3& point) const;     ///< from the grid, trilinear
    Room exact(const Vec3& point) const;  ///< from the cloth
    bool crosses(const Vec3& from, const Vec3& to) const { return crossings_.is_met(from, to); }

    const Vec3& low() const { return low_; }    ///< corners of the garment's box
    const Vec3& high() const { return high_; }
    const Positions& points() const { return points_; }  ///< on the cloth, nowhere further apart than k_point_spacing

private:
    int node(int x, int y, int z) const { return (z * size_.y() + y) * size_.x() + x; }
    void fill(const Progress& progress);

    Vec3 low_, high_;
    Positions points_;
    NearestPoint nearest_;
    WindingNumber winding_;
    TriangleTree crossings_;
    Vec3 origin_ = Vec3::Zero();
    double spacing_ = 0;
    Eigen::Vector3i size_ = Eigen::Vector3i::Zero();
    std::vector<Eigen::Vector2f> nodes_;  // distance, inside
};

}  // namespace fit
