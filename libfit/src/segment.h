// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

#include "fit/types.h"

namespace fit {

/// A segment may have no length: it is a point then.
inline double squared_distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b)
{
    const Vec3 axis = b - a;
    const double t = std::clamp((p - a).dot(axis) / std::max(axis.squaredNorm(), 1e-300), 0.0, 1.0);
    return (a + t * axis - p).squaredNorm();
}

inline double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b)
{
    return std::sqrt(squared_distance_to_segment(p, a, b));
}

}  // namespace fit
