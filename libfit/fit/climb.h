// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The last steps of the fast method: ascent over all degrees of freedom, each in turn and on along what has improved, by steps that are
// halved when none of them helps.

#include "paper_climb.h"
#include "skeleton_search.h"

namespace garmentfit {

struct Steps {
    double first, last;  // radians
};

/// By the energy less the cost of crossings.
Posture polished(const SkeletonSearch& search, const Posture& start, const Steps& steps);

/// One body in several garments, by the sum of their energies less the cost of crossings: bones point alike as seen from the root. Each
/// garment has a root of its own, or all the same. Starts and result: a posture for each of `searches`.
std::vector<Posture> polished_together(const std::vector<const SkeletonSearch*>& searches, std::vector<Posture> starts,
                                       bool one_root, const Steps& steps);

/// By that energy and the paper's E together. Afterwards `paper` knows the posture.
Posture raised(const SkeletonSearch& search, const Posture& start, PaperClimb& paper, const Steps& steps);

/// By the paper's E alone from what `paper` knows, where cloth is wide: no bone loses room that it needs, and no joint goes far.
Posture raised_alone(const SkeletonSearch& search, const Posture& start, PaperClimb& paper, const Steps& steps);

}  // namespace garmentfit
