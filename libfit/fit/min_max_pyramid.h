// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The clearance of a garment on a coarse grid, and its extremes over boxes of any size, for branch and bound.

#include <array>
#include <vector>

#include "clearance.h"
#include "cloth_tree.h"

namespace garmentfit {

/// Bounds of the clearance over a box.
struct ClearanceRange {
    double nearest = 0, furthest = 0;  ///< m; of the distance to the cloth
    double most_inside = 0;  ///< the greatest Clearance::inside
};

class MinMaxPyramid {
public:
    /// Cost: a distance and a winding number for each node of the grid, and an eighth more for the levels above.
    MinMaxPyramid(const ClothTree& cloth, const Vec3& low, const Vec3& high);

    Clearance at(const Vec3& point) const;  ///< trilinear
    /// Bounds `at` for every point of the box: interpolated values lie between those of the nodes about it.
    ClearanceRange range_in(const Vec3& centre, const Vec3& half_size) const;

private:
    /// nearest, -furthest, -most_inside, 0: ranges are joined by one minimum of four lanes.
    using Extremes = Eigen::Array4f;
    struct Level {
        Eigen::Vector3i size;
        std::vector<Extremes> nodes;  // over 2^level nodes along each axis

        std::size_t index(const Eigen::Vector3i& c) const
        {
            return (std::size_t(c.z()) * size.y() + c.y()) * size.x() + c.x();
        }
        const Extremes& at(const Eigen::Vector3i& c) const { return nodes[index(c)]; }
    };
    Level coarsen(const Level& level) const;

    double spacing_;
    Vec3 origin_;
    std::vector<Level> levels_;
};

}  // namespace garmentfit
