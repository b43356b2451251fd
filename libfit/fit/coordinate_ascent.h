// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Coordinate ascent over all degrees of freedom of a posture: each one in turn, then on along what has improved, by
// steps that are halved when none of them helps (pattern search). The last steps of the fast method.

#include "fit_energy.h"
#include "incremental_paper_metric.h"

namespace garmentfit {

/// By the energy less the cost of crossings.
Posture ascend(const FitEnergy& energy, const Posture& start, const AscentSteps& steps);

/// One body in several garments, by the sum of their energies less the cost of crossings. Bones point alike as seen
/// from the root. Each garment has a root of its own, or all share one. Starts and result: a posture for each of
/// `energies`.
std::vector<Posture> ascend_together(const std::vector<const FitEnergy*>& energies, std::vector<Posture> starts,
                                     bool one_root, const AscentSteps& steps);

/// By the sum of that energy and the paper's E. Afterwards the posture is the present one of `paper`.
Posture ascend_with_paper(const FitEnergy& energy, const Posture& start, IncrementalPaperMetric& paper,
                          const AscentSteps& steps);

/// By the paper's E alone, where cloth is wide: no bone loses clearance that it needs, and no joint moves far.
/// @pre  `start` is the present posture of `paper`.
Posture ascend_by_paper(const FitEnergy& energy, const Posture& start, IncrementalPaperMetric& paper,
                        const AscentSteps& steps);

}  // namespace garmentfit
