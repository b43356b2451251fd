// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Makes a garment wider round parts of the body, and keeps its lengths.
//
// Method  Each bone of the body stretches the cloth round it across its axis; vertices blend what their bones do by
//         their skin weights. Shoulder and hip joints move apart with the girth of chest and hips, so that sleeves and
//         trouser legs stay in their places. A tailor grades patterns alike: girths grow, lengths hardly.
// Cost    as garment_weights.

#include <map>
#include <string>

#include "garmentfit/drape_garment.h"

namespace garmentfit {

/// Factor of girth round each part of the body, by the names of TooTight; parts that are not listed stay as they are.
using Widening = std::map<std::string, double>;

/// 1 for a part that is not listed.
GARMENTFIT_API double factor_of(const Widening& widening, const std::string& part);

/// Wider round these parts, too: on both sides alike, and by the larger factor where a part is listed already.
GARMENTFIT_API void widen_both_sides(Widening& widening, const std::string& part, double factor);

/// @param pose  of the body in which the garment lies round it (FitResult::pose)
/// @pre Factors are positive.
GARMENTFIT_API GarmentMesh widen_garment(const Rig& rig, const BodyMesh& body, const Pose& pose,
                                         const GarmentMesh& garment, const Widening& widening);

/// The largest factor; 1 where there is none.
GARMENTFIT_API double largest_factor(const Widening& widening);

}  // namespace garmentfit
