// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a garment is made of.

#include <optional>
#include <string_view>
#include <vector>

#include "garmentfit/export.h"

namespace garmentfit {

/// Fabrics of clothing. docs/fabrics.md has their figures and says where these come from. stretch_woven is cotton or
/// denim woven with elastane; swimwear an elastane knit, also of leggings.
enum class Fabric { cotton, denim, jersey, silk, wool, stretch_woven, rib, fleece, swimwear, leather, tulle };

/// "cotton", "denim", ..., in the order of the values.
GARMENTFIT_API const std::vector<std::string_view>& fabric_names();

/// What the solver knows of a fabric.
struct Material {
    double density;  ///< kg/m^2
    double stretch_stiffness;  ///< N/m, the mean of warp and weft
    double bend_stiffness;  ///< N m
    double friction;  ///< of cloth on body, dimensionless
    double largest_stretch;  ///< l / l0 - 1 round a part of the body, on the mean, that the fabric gives when worn
    double strain_limit;  ///< l / l0 - 1 of an edge; beyond it the cloth is stiffer: its threads or loops are straight
    double thickness;  ///< m; the solver does not use it: contact_distance is larger
    /// Stretch stiffness along the weft (of knits the courses) by that along the warp (the wales), and shear stiffness,
    /// N/m. They count where the garment says how these run (GarmentMesh::warps); else the cloth is alike in all
    /// directions, and its shear stiffness is 3/8 of its stretch stiffness.
    double weft_to_warp, shear_stiffness;
};

/// @throws InvalidInput listing the names
GARMENTFIT_API Fabric fabric_of(std::string_view name);

/// The figures of a fabric as tabled.
GARMENTFIT_API Material material_of(Fabric fabric);

/// Units: metres, kilograms, seconds. The default lengths are fitted: guesses, on the pairs of the house data that
/// cloth/tuning.h describes. They stand here because they are part of the interface.
struct ClothOptions {
    Fabric fabric = Fabric::cotton;
    double contact_distance = 2.5e-3;  ///< m; contact force begins below this distance
    double min_distance = 1e-4;  ///< m; motion is cut before a distance falls below this
    std::optional<double> density {};  ///< kg/m^2; this and the next six: of the fabric where not given
    std::optional<double> stretch_stiffness {};  ///< N/m
    std::optional<double> bend_stiffness {};  ///< N m
    std::optional<double> friction {};  ///< of cloth on body, dimensionless
    /// A garment is too small where a part of the body stretches it by more, on the mean.
    std::optional<double> largest_stretch {};
    std::optional<double> weft_to_warp {};
    std::optional<double> shear_stiffness {};  ///< N/m
    double largest_enlargement = 0;  ///< fraction by which a garment that is too small may be enlarged
};

/// The figures of the fabric, replaced by those that `options` gives.
GARMENTFIT_API Material material_of(const ClothOptions& options);
/// The same of another fabric than that of `options`: of one garment among several.
GARMENTFIT_API Material material_of(const ClothOptions& options, Fabric fabric);

/// The fabric that gives at least so much, and more than the present one, and of these the one that gives least; none
/// where no fabric does.
/// @param stretch  l / l0 - 1
GARMENTFIT_API std::optional<Fabric> fabric_that_gives(double stretch, double present);

/// unit: a share of the weight of a vertex's cloth. Forces balance where no more is left of them on the mean, and ten
/// times as much in 99 of 100 vertices.
constexpr double k_balanced = 0.02;

/// What is left of all forces on the cloth at the end: elastic forces, gravity, contact, and friction inside its cone.
/// Dimensionless, shares of the weight of each vertex's cloth.
struct ForceResidual {
    double mean = 0;
    double percentile_99 = 0;

    bool is_at_rest() const { return mean <= k_balanced && percentile_99 <= 10 * k_balanced; }
};

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
