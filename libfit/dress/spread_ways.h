// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Takes along what lies round places that have to move: as if it were in soft rubber, whatever part it belongs to.

#include "garmentfit/types.h"

namespace garmentfit {

/// The ways of places, n x 3: nearly their own for those that have one, blended ones for those near them, fading with the
/// distance. If `radius` is twice and a half the longest way, it is a motion of space that grows by less from place to place
/// than they are apart: sheets of cloth between which there is an order keep it, however near they are to each other and
/// whatever triangles they are made of, as long as edges are short against `radius`.
/// Cost O(n log n).
/// @param places  n x 3, metres
/// @param ways    n x 3, metres; 0 where something is only taken along
/// @param radius  m, how far from a place its way is felt
Positions spread_ways(const Positions& places, const Positions& ways, double radius);

}  // namespace garmentfit
