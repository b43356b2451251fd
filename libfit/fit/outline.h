// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Outline of a garment that is held upright: what it is, by its widths.

#include <vector>

#include "cloth_tree.h"
#include "garment_openings.h"
#include "type_guess.h"

namespace garmentfit {

/// Logarithm of the girth of the highest wide opening over that of the cloth a quarter of a leg below it, in tenths,
/// from -k_max_taper to k_max_widening: a waist is narrower than hips, the rim of a strapless dress no narrower than a
/// waist. Girths are of convex hulls, because of folds and uneven rims. 0 where there are openings for arms, or
/// any others: necks are narrow.
/// @param leg  m
double taper_of(const std::vector<ClothPatch>& cloth, const std::vector<Opening>& openings, const GarmentCues& cues,
                double leg);

/// Logarithm of the greatest width at any height over that of the widest end, in tenths, at most k_max_reach. Ends are
/// openings that face up or down. Sleeves reach beyond hem and neck, whether openings lead to them or not; a skirt is
/// widest at its hem, or a little above. 0 without an end.
double reach_of(const std::vector<ClothPatch>& cloth, const std::vector<Opening>& openings);

}  // namespace garmentfit
