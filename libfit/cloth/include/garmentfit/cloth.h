// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a garment is made of.

#include <optional>
#include <string_view>
#include <vector>

#include "garmentfit/export.h"

namespace garmentfit {

/// Fabrics of clothing. docs/cloth.md has their figures and says where these come from.
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

/// Units: metres, kilograms, seconds. The default lengths and largest_stretch are fitted: guesses, on the pairs of the
/// house data that cloth/tuning.h describes. They stand here because they are part of the interface.
struct ClothOptions {
    Fabric fabric = Fabric::cotton;
    double contact_distance = 2.5e-3;  ///< m; contact force begins below this distance
    double min_distance = 1e-4;  ///< m; motion is cut before a distance falls below this
    std::optional<double> density {};  ///< kg/m^2; this and the next three: of the fabric where not given
    std::optional<double> stretch_stiffness {};  ///< N/m
    std::optional<double> bend_stiffness {};  ///< N m
    std::optional<double> friction {};  ///< of cloth on body, dimensionless
    double largest_stretch
        = 0.15;  ///< a garment is too small where a part of the body stretches it by more, on the mean
    double largest_enlargement = 0;  ///< fraction by which a garment that is too small may be enlarged
};

/// The figures of the fabric, replaced by those that `options` gives.
GARMENTFIT_API Material material_of(const ClothOptions& options);

/// m/s. Cloth counts as settled when no vertex is faster than this.
/// fitted: guess, on the house data, where cloth that looks at rest still creeps by some millimetres a second. It
/// stands here because programs compare speeds with it, too.
constexpr double k_at_rest = 0.02;

/// Where the time of moving cloth went, s, by the wall clock.
struct ClothSeconds {
    double detection = 0;  ///< contact detection and collision-free steps
    double solver = 0;  ///< conjugate gradients

    ClothSeconds& operator+=(const ClothSeconds& more)
    {
        detection += more.detection;
        solver += more.solver;
        return *this;
    }
};

}  // namespace garmentfit
