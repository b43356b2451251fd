// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where and which way round a body stands best in a garment, before its limbs are searched finely.

#include <vector>

#include "fit_energy.h"
#include "garmentfit/progress.h"

namespace garmentfit {

/// A way in which the body may stand in the garment; place and limbs are searched.
struct StartHypothesis {
    Eigen::Quaterniond turn;  ///< world from the axes of the input body
};

/// The trunk upright, its heading kept, then rotated about the vertical by `heading`, rad.
Eigen::Quaterniond upright_turn(const Rig& rig, double heading);

/// The facings that the garment's cues allow: from sleeve to sleeve or leg to leg, either way round. Without such
/// pairs: along and across the garment, and as the input body faces.
std::vector<StartHypothesis> facing_hypotheses(const FitEnergy& energy);

/// Places of the body with its covered limbs searched, best energy first. Bones may still pass through cloth.
std::vector<Posture> find_rough_starts(const FitEnergy& energy, const std::vector<StartHypothesis>& hypotheses);

/// The ascents from the best rough start, from the best of each facing, and from `others`; best energy first. Where one
/// fails, other rough starts of its facing are tried. Cost: about ten times find_rough_starts.
std::vector<Posture> ascend_starts(const FitEnergy& energy, const std::vector<Posture>& rough,
                                   const std::vector<Posture>& others);

/// Searches all limbs of a start once more, frees them from the cloth, and ascends over all degrees of freedom.
Posture refine_posture(const FitEnergy& energy, const Posture& start);

}  // namespace garmentfit
