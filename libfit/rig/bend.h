// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Elbow and knee from the middles of cuts across a limb.

#include "centreline.h"

namespace garmentfit {

/// The joint between two bones. A line through flesh cuts the corner of a bent limb: there the bones' own axes are made
/// to meet, read off well away from the bend.
/// @param from, to  rows of the line that belong to the two bones
/// @param root  where the upper bone begins, m
/// @param usual_ratio  of the upper bone's length to both: decides where the limb is straight
/// @param size  stature, m
Vec3 bend(const Centreline& line, int from, int to, const Vec3& root, double usual_ratio, double size);

}  // namespace garmentfit
