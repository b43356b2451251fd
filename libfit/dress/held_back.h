// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "garmentfit/drape_garment.h"

namespace garmentfit {

/// Lists the parts of a body (n x 3) that have not reached their targets, worst first.
std::vector<HeldBack> list_held_back_parts(const Positions& reached, const Positions& target,
                                           const SkinWeights& weights);

}  // namespace garmentfit
