// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What girths along a limb say about its end: a hand, a foot or a stump.

#include "centreline.h"

namespace garmentfit {

struct ReachRange {
    double least, usual, most, spread;  ///< m, straight to the limb's tip
};

/// Where a limb is narrowest before it widens to the hand or the heel.
struct Narrowest {
    int row = -1;  ///< -1: it is nowhere free
    bool widens = false;
};

/// A reach unlike the usual one counts as a larger girth.
Narrowest narrowest(const Centreline& line, const Vec3& tip, const ReachRange& reach);

/// @param size  stature, m
bool has_hand(const Centreline& line, double size);
bool has_foot(const Centreline& line, double size);

}  // namespace garmentfit
