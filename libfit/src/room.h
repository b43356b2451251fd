// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

namespace fit {

/// What a garment offers to a point: how far the cloth is, and how surely the point is inside.
struct Room {
    double distance = 0;  ///< m, to the nearest cloth
    double inside = 0;  ///< 1 inside, 0 outside, between the two on the way through an opening
};

/// Winding numbers: about 0.5 in the plane of an opening, 0.25 a radius outside of it, about 0 behind cloth.
inline double inside_of(double winding)
{
    constexpr double surely_outside = 0.25, surely_inside = 0.45;
    return std::clamp((winding - surely_outside) / (surely_inside - surely_outside), 0.0, 1.0);
}

}  // namespace fit
