// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where and which way round a body stands best in a garment, before its limbs are settled to the last degree.

#include "garmentfit/progress.h"
#include "skeleton_search.h"

namespace garmentfit {

struct BestStart {
    Posture posture;
    double front_margin;  // 0 (as good facing the other way) to 1
};

/// The trunk stands upright, its heading kept, then turned about the vertical.
Eigen::Quaterniond upright(const Rig& rig, double heading);

BestStart best_start(const Rig& rig, const SkeletonSearch& search, const Progress& progress);

/// The start settled: every limb reconsidered and freed from the cloth, then all degrees of freedom polished.
Posture refined(const SkeletonSearch& search, const Posture& start);

}  // namespace garmentfit
