// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Tells the rows of one mesh of several garments apart again.

#include <vector>

#include "garmentfit/drape_garment.h"

namespace garmentfit {

/// Writes the rows of `positions`, garment after garment, into the garments.
void set_positions(std::vector<WornGarment>& garments, const Positions& positions);

/// Adds to each garment how far it sank, by the median of its vertices.
/// @param followed  where the vertices would be, garment after garment, had they gone along with the body
void add_slips(std::vector<WornGarment>& garments, const Positions& followed);

/// Measures of each garment how far its pieces went from each other.
void measure_piece_shifts(std::vector<WornGarment>& garments);

}  // namespace garmentfit
