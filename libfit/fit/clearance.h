// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the distance to the cloth is worth to a point of a limb.

#include <algorithm>

#include "tuning.h"

namespace garmentfit {

/// What a garment offers to a point.
struct Clearance {
    double distance = 0;  ///< m, to the nearest cloth
    double inside = 0;  ///< 1 inside, 0 outside, between them in an opening

    bool is_inside() const { return inside > 0.5; }  // derived: the middle
};

/// The inside of a Clearance by the winding number.
inline double inside_of(double winding)
{
    return std::clamp((winding - k_winding_outside) / (k_winding_inside - k_winding_outside), 0.0, 1.0);
}

/// The value of a distance to a point inside, on a limb of this radius, m. Increasing, and bounded by
/// max_clearance_value.
inline double inside_value(double distance, double radius)
{
    return std::min(distance, radius) + k_surplus * std::clamp(distance - radius, 0.0, radius);
}

/// Equation (3) of [wu_2018_garment_fitting] with its two changes: distance counts as far as the limb needs it, and
/// being outside costs the distance, not a hundred times that. m.
inline double clearance_value(const Clearance& clearance, double radius)
{
    return clearance.inside * inside_value(clearance.distance, radius)
        - (1 - clearance.inside) * std::min(clearance.distance, k_outside_cap);
}

/// derived: inside_value at infinite distance.
inline double max_clearance_value(double radius) { return (1 + k_surplus) * radius; }

}  // namespace garmentfit
