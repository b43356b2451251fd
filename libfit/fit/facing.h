// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Which way the body faces in a garment: a probability for each facing that was searched.
//
// Method  conditional logit [mcfadden_1974_conditional_logit]: the probability of a facing is proportional to the
//         exponential of its weighted evidence. The weights are fitted on garments of known facing (tuning.h).

#include <vector>

#include "fit_energy.h"

namespace garmentfit {

/// What is known of one facing.
struct FacingEvidence {
    Vec3 front;  ///< unit; of the body as it stands in the garment
    double energy = 0;  ///< m; of its best posture, less that of the best facing: 0 or less
    /// Cosine between `front` and the front of the input body: most garments come in the frame of their body.
    double input_front = 0;
    /// Sum over the openings that face forwards or backwards (cues_of), along `front`.
    double openings = 0;
};

/// Of postures with their energies (m, less the cost of crossings), in the same order.
std::vector<FacingEvidence> facing_evidence(const FitEnergy& energy, const std::vector<Posture>& postures,
                                            const std::vector<double>& energies);

/// In the order of the evidence; they sum to 1. Facings less than 60 degrees apart are one: each of them has the
/// probability of the best of them.
std::vector<double> facing_probabilities(const std::vector<FacingEvidence>& evidence);

}  // namespace garmentfit
