// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Beam search for the directions of a limb's two bones.

#include "fit_energy.h"

namespace garmentfit {

/// The posture with the limb's best chain of bones on the grid, and the given one where every chain passes through
/// cloth. Directions are sorted by distance from the present one: of equals, the nearest wins.
Posture search_limb(const FitEnergy& energy, const Posture& present, const Limb& limb, const LimbGrid& grid);

}  // namespace garmentfit
