// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where a rigid set of points has the most room: branch and bound, so that the best place is certain without trying all
// (derived in docs/fit.md).

#include <cmath>
#include <limits>
#include <vector>

#include "min_max_pyramid.h"

namespace garmentfit {

/// A point that moves with the rest, and the radius of its limb.
struct RoomSample {
    Vec3 offset;  // m
    double radius;  // m
};

struct Place {
    Vec3 at;
    double value;  // m
};

/// What lies between two parallel planes; everything, unless told otherwise.
struct Slab {
    Vec3 middle = Vec3::Zero();  // m
    Vec3 across = Vec3::UnitX();
    double half_width = std::numeric_limits<double>::infinity();  // m

    bool is_missed_by(const Vec3& centre, const Vec3& half_size) const
    {
        return std::abs(across.dot(centre - middle)) > half_width + across.cwiseAbs().dot(half_size);
    }
};

class ClearanceSearch {
public:
    /// @param slope  what a metre along each axis is worth besides, m/m
    /// @param slab  where to look. Keeps a reference to the cloth.
    ClearanceSearch(const MinMaxPyramid& cloth, std::vector<RoomSample> samples, const Vec3& slope, const Slab& slab = {});

    double value(const Vec3& at) const;

    /// No place in the box about `centre` is worth more.
    double bound(const Vec3& centre, const Vec3& half_size) const;

    /// The best places of a grid no coarser than `spacing`, best first, none nearer to a better one than `apart`.
    std::vector<Place> best(const Vec3& low, const Vec3& high, double spacing, double apart, std::size_t count) const;

private:
    const MinMaxPyramid& cloth_;
    std::vector<RoomSample> samples_;
    Vec3 slope_;
    Slab slab_;
};

}  // namespace garmentfit
