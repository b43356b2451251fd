// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "garmentfit/drape_garment.h"

namespace garmentfit {

/// Parts that are not yet in their places, worst first.
std::vector<HeldBack> held_back(const Positions& reached, const Positions& target, const SkinWeights& weights);

}  // namespace garmentfit
