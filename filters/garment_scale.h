// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Whether a garment has the size of its unit, or a normalised one that no unit explains.

#include <optional>
#include <span>
#include <vector>

#include "garmentfit/garment_size.h"
#include "garmentfit/types.h"

namespace garmentfit {

struct ScaleGuess {
    double factor = 1;  ///< by which its unit is multiplied
    double probability = 1;  ///< that the factor is right, or as good as right (k_same_size)
    double unit_factor = 1, unit_probability = 0;  ///< the same of the most probable unit
};

/// Of the faces' corners: files hold vertices that no face uses.
Vec3 extents_of(const Positions& positions, const Triangles& triangles);

/// Whether the longest side of a mesh is one or two units long, as programs make it that scale models of any size
/// alike.
bool is_normalised(const Positions& positions, const Triangles& triangles);

/// Density of the size of those for whom garments are made, who are not as large as the body that wears them.
/// @param log_stature  natural logarithm of their stature over the body's
double density_of_others(double log_stature);

/// How tall the people are whom a garment fits, by the median of its measures, m; none where it has no measures.
std::optional<double> median_wearer(std::span<const WearerHeight> wearers);

/// @param wearers  of the garment in the unit guessed (wearer_heights)
/// @param length  of the garment as it hangs, from its highest to its lowest point, in the unit guessed, m
/// @param height  of the body, m
/// @param metres_per_unit  as guessed
/// @param usual_unit  m, of the file's format, or else of the body's file: others are rarer
/// @param normalised  is_normalised: the file has hardly a unit
ScaleGuess guess_scale(const std::vector<WearerHeight>& wearers, double length, double height, double metres_per_unit,
                       double usual_unit, bool normalised = false);

}  // namespace garmentfit
