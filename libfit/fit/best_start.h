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

struct HypothesisScore {
    Posture posture;  ///< the best of this hypothesis
    double energy = 0;  ///< m; less the cost of crossings
    double clearance_share = 0;  ///< of the clearance that covered bones need
    int bones_through_cloth = 0;
};

/// The starts that are left of all hypotheses, best first. They compete from the first step, so that most are dropped
/// early; the best of each facing is kept.
std::vector<HypothesisScore> find_starts(const FitEnergy& energy, const std::vector<StartHypothesis>& hypotheses,
                                         const Progress& progress);

struct BestStart {
    Posture posture;
    double front_probability;  // that the body faces this way, of all facings that were searched
};

/// The best of find_starts that has the most probable facing (facing.h).
BestStart find_best_start(const FitEnergy& energy, const std::vector<StartHypothesis>& hypotheses,
                          const Progress& progress);

/// Each hypothesis by itself, in the given order: all of them are searched to the same depth.
/// Cost: about a third of find_best_start for each hypothesis.
std::vector<HypothesisScore> score_hypotheses(const FitEnergy& energy, const std::vector<StartHypothesis>& hypotheses,
                                              const Progress& progress);

/// Searches all limbs of a start once more, frees them from the cloth, and ascends over all degrees of freedom.
Posture refine_posture(const FitEnergy& energy, const Posture& start);

}  // namespace garmentfit
