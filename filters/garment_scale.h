// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Whether a garment has the size of its unit, or a normalised one that no unit explains.

#include <vector>

#include "garmentfit/garment_size.h"

namespace garmentfit {

struct ScaleGuess {
    double factor = 1;  ///< by which its unit is multiplied
    double probability = 1;  ///< that the factor is right, or as good as right (k_same_size)
};

/// @param wearers  of the garment in the unit guessed (wearer_heights)
/// @param length  of the garment as it hangs, from its highest to its lowest point, in the unit guessed, m
/// @param height  of the body, m
/// @param metres_per_unit  as guessed
/// @param body_unit  m, of the body's file
ScaleGuess guess_scale(const std::vector<WearerHeight>& wearers, double length, double height, double metres_per_unit,
                       double body_unit);

}  // namespace garmentfit
