// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a garment is made of.

#include <optional>
#include <string_view>
#include <vector>

#include "garmentfit/export.h"

namespace garmentfit {

/// Fabrics of clothing, each with figures in the middle of what is measured for its kind (docs/drape.md names the sources).
enum class Fabric { cotton, denim, jersey, silk, wool };

/// "cotton", "denim", ..., in the order of the values.
GARMENTFIT_API const std::vector<std::string_view>& fabric_names();

/// What the solver knows of a fabric.
struct Material {
    double density;  ///< kg/m^2
    double stretch_stiffness;  ///< N/m
    double bend_stiffness;  ///< N m
    double friction;  ///< of cloth on body, dimensionless
};

/// Units: metres, kilograms, seconds.
struct ClothOptions {
    Fabric fabric = Fabric::cotton;
    double contact_distance = 2.5e-3;  ///< m; contact force begins below this gap
    double min_distance = 1e-4;  ///< m; motion is cut before a gap falls below this
    std::optional<double> density {};  ///< kg/m^2; this and the next three: of the fabric where not given
    std::optional<double> stretch_stiffness {};  ///< N/m
    std::optional<double> bend_stiffness {};  ///< N m
    std::optional<double> friction {};  ///< of cloth on body, dimensionless
    double largest_stretch
        = 0.15;  ///< a garment is too small where a part of the body stretches it by more, on the mean
    double largest_enlargement = 0;  ///< share by which a garment that is too small may be made larger, all of it alike
};

/// The figures of the fabric, replaced by those that `options` gives.
GARMENTFIT_API Material material_of(const ClothOptions& options);

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
