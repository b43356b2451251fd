// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// One mesh of several garments as several again.

#include <vector>

#include "garmentfit/drape_garment.h"

namespace garmentfit {

/// Puts the rows of `positions`, garment after garment, back into the garments.
void put_positions(std::vector<WornGarment>& garments, const Positions& positions);

/// Adds how far each garment sank from where it would be, its vertices garment after garment, had it gone along with the body.
void add_slips(std::vector<WornGarment>& garments, const Positions& along);

}  // namespace garmentfit
