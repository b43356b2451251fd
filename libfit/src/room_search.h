// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where a rigid set of points has the most room: branch and bound, so that the best place is certain without trying all
// (derived in docs/fit.md).

#include <vector>

#include "room_pyramid.h"

namespace fit {

/// A point that moves with the rest, and the radius of its limb.
struct RoomSample {
    Vec3 offset;  // m
    double radius;  // m
};

struct Place {
    Vec3 at;
    double value;  // m
};

class RoomSearch {
public:
    /// @param slope  what a metre along each axis is worth besides, m/m. Keeps a reference to the cloth.
    RoomSearch(const RoomPyramid& cloth, std::vector<RoomSample> samples, const Vec3& slope);

    double value(const Vec3& at) const;

    /// No place in the box about `centre` is worth more.
    double bound(const Vec3& centre, const Vec3& half_size) const;

    /// The best places of a grid no coarser than `spacing`, best first, none nearer to a better one than `apart`.
    std::vector<Place> best(const Vec3& low, const Vec3& high, double spacing, double apart, std::size_t count) const;

private:
    const RoomPyramid& cloth_;
    std::vector<RoomSample> samples_;
    Vec3 slope_;
};

}  // namespace fit
