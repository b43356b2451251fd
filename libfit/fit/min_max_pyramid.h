// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The room that a garment offers, coarsely, and its extremes over boxes of any size: what branch and bound asks for.

#include <array>
#include <vector>

#include "cloth_tree.h"
#include "clearance.h"

namespace garmentfit {

/// What a garment offers to all points of a box.
struct RoomRange {
    double nearest = 0, furthest = 0;  ///< m; no point is nearer to the cloth or further away
    double most_inside = 0;  ///< no point is more surely inside
};

class MinMaxPyramid {
public:
    /// Cost: a distance and a winding number for each node of the grid, and an eighth more for the levels above.
    MinMaxPyramid(const ClothTree& cloth, const Vec3& low, const Vec3& high);

    Clearance at(const Vec3& point) const;  ///< trilinear
    /// Holds for `at` of every point of the box: what is interpolated lies between the nodes about it.
    RoomRange within(const Vec3& centre, const Vec3& half_size) const;

private:
    /// A range whose extremes are all least: nearest, -furthest, -most_inside. Any number is joined by minima, four at a time.
    using Least = Eigen::Array4f;
    struct Level {
        Eigen::Vector3i size;
        std::vector<Least> nodes;  // over 2^level nodes along each axis

        std::size_t index(const Eigen::Vector3i& c) const
        {
            return (std::size_t(c.z()) * size.y() + c.y()) * size.x() + c.x();
        }
        const Least& at(const Eigen::Vector3i& c) const { return nodes[index(c)]; }
    };
    Level above(const Level& level) const;

    double spacing_;
    Vec3 origin_;
    std::vector<Level> levels_;
};

}  // namespace garmentfit
