// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// For whom a garment was made, by its parts.

#include <vector>

#include "garmentfit/export.h"
#include "garmentfit/mesh.h"

namespace garmentfit {

/// Statures of people whom a part of the garment would fit, m: one for each of its shoulders, sleeves, trunk and legs
/// that is found. Empty where no opening is recognised, as in a garment that is not upright. O(n log n).
GARMENTFIT_API std::vector<double> wearer_heights(const GarmentMesh& garment);

}  // namespace garmentfit
