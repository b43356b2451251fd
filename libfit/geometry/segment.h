// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

#include "garmentfit/types.h"

namespace garmentfit {

/// @pre none: a segment without length is a point.
inline Vec3 nearest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b)
{
    const Vec3 axis = b - a;
    return a
        + std::clamp((p - a).dot(axis) / std::max(axis.squaredNorm(), 1e-300), 0.0, 1.0) * axis;  // unit: avoids 0 / 0
}

inline double squared_distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b)
{
    return (nearest_on_segment(p, a, b) - p).squaredNorm();
}

inline double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b)
{
    return std::sqrt(squared_distance_to_segment(p, a, b));
}

}  // namespace garmentfit
