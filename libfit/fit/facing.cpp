// SPDX-License-Identifier: GPL-3.0-or-later
#include "facing.h"

#include <algorithm>
#include <cmath>

#include "tuning.h"

namespace garmentfit {
namespace {

double log_odds(const FacingEvidence& evidence)
{
    return k_facing_weights.energy * evidence.energy + k_facing_weights.input_front * evidence.input_front
        + k_facing_weights.openings * evidence.openings;
}

bool is_same_facing(const FacingEvidence& a, const FacingEvidence& b)
{
    return a.front.dot(b.front) > 0.5;  // derived: 60 degrees, between quarter turns and noise
}

}  // namespace

std::vector<FacingEvidence> facing_evidence(const FitEnergy& energy, const std::vector<Posture>& postures,
                                            const std::vector<double>& energies)
{
    const double best = *std::max_element(energies.begin(), energies.end());
    const Vec3 input_front = energy.rig().front;
    std::vector<FacingEvidence> evidence;
    for (std::size_t i = 0; i < postures.size(); ++i) {
        const Vec3 front = postures[i].turn * input_front;
        const Vec3 level = Vec3(front.x(), 0, front.z()).stableNormalized();
        evidence.push_back(
            { front, std::max(energies[i] - best, -k_max_energy_evidence), front.dot(input_front),
              std::clamp(level.dot(energy.cues().front), -k_max_opening_evidence, k_max_opening_evidence) });
    }
    return evidence;
}

std::vector<double> facing_probabilities(const std::vector<FacingEvidence>& evidence)
{
    std::vector<double> best(evidence.size());  // log odds of the best of the same facing
    for (std::size_t i = 0; i < evidence.size(); ++i) {
        best[i] = log_odds(evidence[i]);
        for (const FacingEvidence& other : evidence)
            if (is_same_facing(evidence[i], other))
                best[i] = std::max(best[i], log_odds(other));
    }
    double sum = 0;  // each facing once: by the first of those that are the same
    for (std::size_t i = 0; i < evidence.size(); ++i) {
        const bool is_first
            = std::none_of(evidence.begin(), evidence.begin() + std::ptrdiff_t(i),
                           [&](const FacingEvidence& other) { return is_same_facing(evidence[i], other); });
        if (is_first)
            sum += std::exp(best[i]);
    }
    std::vector<double> probabilities;
    for (const double one : best)
        probabilities.push_back(std::min(1.0, std::exp(one) / sum));
    return probabilities;
}

}  // namespace garmentfit
