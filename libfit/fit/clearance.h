// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

namespace garmentfit {

/// What a garment offers to a point: how far the cloth is, and how surely the point is inside.
struct Clearance {
    double distance = 0;  ///< m, to the nearest cloth
    double inside = 0;  ///< 1 inside, 0 outside, between the two on the way through an opening
};

/// Winding numbers: about 0.5 in the plane of an opening, 0.25 a radius outside of it, about 0 behind cloth.
inline double inside_of(double winding)
{
    constexpr double surely_outside = 0.25, surely_inside = 0.45;
    return std::clamp((winding - surely_outside) / (surely_inside - surely_outside), 0.0, 1.0);
}

inline constexpr double k_largest_outside = 0.1;  // m; further out is not worse: long arms reach beyond their cuffs
inline constexpr double k_surplus
    = 0.15;  // of the room beyond what the limb needs: keeps bones in the middle, yet a chest
// does not draw an arm out of its sleeve

/// What distance to the cloth is worth to a point inside, of a limb of this radius, m.
inline double inside_value(double distance, double radius)
{
    return std::min(distance, radius) + k_surplus * std::clamp(distance - radius, 0.0, radius);
}

/// What room is worth to it: equation (3), with the room counted up to what the limb needs.
inline double clearance_value(const Clearance& clearance, double radius)
{
    return clearance.inside * inside_value(clearance.distance, radius)
        - (1 - clearance.inside) * std::min(clearance.distance, k_largest_outside);
}

/// No room is worth more.
inline double max_clearance_value(double radius) { return (1 + k_surplus) * radius; }

}  // namespace garmentfit
