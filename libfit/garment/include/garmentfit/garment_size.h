// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// For whom a garment was made, by its parts.

#include <vector>

#include "garmentfit/export.h"
#include "garmentfit/mesh.h"

namespace garmentfit {

/// What one measure of a garment says of the person whom it fits.
struct WearerHeight {
    double height = 0;  ///< stature of the usual wearer, m
    double spread = 0;  ///< of its natural logarithm, among garments that fit
    bool is_least = false;  ///< taller ones it fits as well
};

/// By each of its shoulders, sleeves, trunk and legs that is found, by its width and depth, which need no opening, and by
/// the length of trousers and of sleeves, which do not reach below the feet and beyond the hands.
/// The garment is upright. O(n log n).
GARMENTFIT_API std::vector<WearerHeight> wearer_heights(const GarmentMesh& garment);

}  // namespace garmentfit
