// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a garment is made of.

#include <string_view>
#include <vector>

#include "garmentfit/export.h"

namespace garmentfit {

/// Fabrics of clothing, each with figures in the middle of what is measured for its kind (docs/drape.md names the sources).
enum class Fabric { cotton, denim, jersey, silk, wool };

/// "cotton", "denim", ..., in the order of the values.
GARMENTFIT_API const std::vector<std::string_view>& fabric_names();

/// Units: metres, kilograms, seconds.
struct ClothOptions {
    Fabric fabric = Fabric::cotton;
    double contact_distance = 2.5e-3;  ///< m; contact force begins below this gap
    double min_distance = 1e-4;  ///< m; motion is cut before a gap falls below this
    double density = 0.2;  ///< kg/m^2
    double stretch_stiffness = 400;  ///< N/m
    double bend_stiffness = 2e-5;  ///< N m
    double friction = 0.4;  ///< of cloth on body, dimensionless
    double largest_stretch
        = 0.15;  ///< a garment is too small where a part of the body stretches it by more, on the mean
    double largest_enlargement = 0;  ///< share by which a garment that is too small may be made larger, all of it alike
};

/// Density, stiffness and friction that are still the defaults above (cotton's) become those of `options.fabric`; what was
/// set stays.
GARMENTFIT_API ClothOptions apply_fabric(ClothOptions options);

/// Cloth counts as settled when no vertex is faster than this, m/s.
constexpr double k_at_rest = 0.02;

/// Where the time of moving cloth went, s, by the wall clock.
struct ClothSeconds {
    double detection = 0;  ///< looking for what is near, and cutting motions before it
    double solver = 0;  ///< going down the cloth's energy

    ClothSeconds& operator+=(const ClothSeconds& more)
    {
        detection += more.detection;
        solver += more.solver;
        return *this;
    }
};

}  // namespace garmentfit
