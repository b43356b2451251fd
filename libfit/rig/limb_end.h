// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The end of a limb from the girths along it: a hand, a foot or a stump.

#include "centreline.h"

namespace garmentfit {

/// Where a limb's narrowest part may be: limits, mean and standard deviation of its straight distance from the tip, m.
struct TipDistance {
    double least, usual, most, spread;
};

/// The narrowest cut of a limb before it widens to the hand or the heel.
struct Narrowest {
    int row = -1;  ///< of the centre line; -1: no cut within the limits is free
    bool widens = false;
};

/// A distance that differs from the mean counts as a larger girth: the most likely cut is chosen.
Narrowest find_narrowest(const Centreline& line, const Vec3& tip, const TipDistance& distance);

/// Whether a limb ends thin like fingers or toes, widens towards its end, or, an arm, does not taper, or, a leg, bends
/// at its end. @param size  stature, m
bool has_hand(const Centreline& line, double size);
bool has_foot(const Centreline& line, double size);

/// Stricter, for what may be clothes: widens, and ends thin like fingers, or, a leg, bends at its end like toes.
bool shows_hand(const Centreline& line, double size);
bool shows_foot(const Centreline& line, double size);

}  // namespace garmentfit
