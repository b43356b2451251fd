// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Elbow and knee from the centroids of cuts across a limb.

#include "centreline.h"

namespace garmentfit {

/// Places the joint between two bones. The line of centroids cuts the corner of a bent limb. There the joint is the
/// intersection of the bones' axes, which are fitted away from the bend.
/// @param from, to  rows of the line that belong to the two bones
/// @param root  where the upper bone begins, m
/// @param usual_ratio  of the upper bone's length to the limb's: decides if the limb is straight
/// @param size  stature, m
Vec3 place_bend(const Centreline& line, int from, int to, const Vec3& root, double usual_ratio, double size);

}  // namespace garmentfit
