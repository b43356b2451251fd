// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Which axis of a garment's file is up, by its openings.

#include <vector>

#include "garmentfit/export.h"
#include "garmentfit/mesh.h"

namespace garmentfit {

/// Evidence of the openings that a garment is upright where each of some directions is up, less that for the same
/// upside down: from -1, against it, to 1. Legs and sleeves point down, a waist is narrower than a hem, and what is
/// worn is higher than deep. All 0 where no opening is recognised.
/// @param garment  in metres of human size, in any axes
/// @param ups  unit, in the axes of the garment
/// Cost O(n log n), and O(n) more for each direction.
GARMENTFIT_API std::vector<double> evidence_for_up(const GarmentMesh& garment, const std::vector<Vec3>& ups);

}  // namespace garmentfit
