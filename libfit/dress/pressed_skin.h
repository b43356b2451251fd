// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Skin that stays where cloth holds it back: flesh gives way, and a body that crosses itself has no other place for cloth
// (docs/decisions/0055-pressed-skin.md).

#include "garmentfit/types.h"

namespace garmentfit {

/// Skin (n x 3) that stopped at the cloth, drawn back into the body by so much more that the cloth has room, and the
/// skin round it less and less. O(n)
/// @param pressed    where cloth holds it
/// @param own        its place, n x 3; what is there to the bit is not pressed
/// @param triangles  of the body
/// @param by         m
Positions give_way(const Positions& pressed, const Positions& own, const Triangles& triangles, double by);

}  // namespace garmentfit
