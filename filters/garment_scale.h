// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Whether a garment has the size of its unit, or a normalised one that no unit explains.

#include <vector>

namespace garmentfit {

struct ScaleGuess {
    double factor = 1;  ///< by which its unit is multiplied
    double probability = 1;  ///< that the factor is right
};

/// @param statures  of people whom the garment's parts would fit in the unit guessed, m (wearer_heights)
/// @param length  of the garment as it hangs, from its highest to its lowest point, in the unit guessed, m
/// @param height  of the body, m
/// @param metres_per_unit  as guessed
/// @param as_body  the guess is the unit of the body
ScaleGuess guess_scale(const std::vector<double>& statures, double length, double height, double metres_per_unit,
                       bool as_body);

}  // namespace garmentfit
