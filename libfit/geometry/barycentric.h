// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>

#include "garmentfit/types.h"

namespace garmentfit {

/// Weights of the corners of a triangle at a point of it: 0 to 1, with the sum 1. All on the first corner where the
/// triangle has no area.
inline std::array<double, 3> barycentric(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c)
{
    const Vec3 normal = (b - a).cross(c - a);
    const double square = normal.squaredNorm();
    if (!(square > 0))
        return { 1, 0, 0 };
    const double at_a = std::clamp((b - point).cross(c - point).dot(normal) / square, 0.0, 1.0);
    const double at_b = std::clamp((c - point).cross(a - point).dot(normal) / square, 0.0, 1 - at_a);
    return { at_a, at_b, 1 - at_a - at_b };
}

}  // namespace garmentfit
