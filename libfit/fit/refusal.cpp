// SPDX-License-Identifier: GPL-3.0-or-later
#include "refusal.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "garmentfit/number_text.h"
#include "quantile.h"
#include "tuning.h"
#include "type_guess.h"

namespace garmentfit {
namespace {

std::string times(double share)
{
    return share > 1 ? rounded_text(share, 2) + " times" : std::to_string(std::lround(100 * share)) + "% of";
}

// What the user gave, and may take back.
std::optional<std::string> given_text(const FitOptions& options)
{
    if (options.as_placed)
        return "where it was placed; leave as_placed out, or check the garment's unit and axes";
    if (options.front)
        return "with its front where it was given; check garment_front, or leave it out and let the program find it";
    if (options.type != GarmentType::automatic)
        return "as a garment of type " + std::string(name_of(options.type))
            + "; check the type and the garment's unit, or leave the type out";
    return {};
}

std::string whose_parts(double share)
{
    return "its shoulders, sleeves, trunk and legs are those of people of " + times(share) + " this body's height; ";
}

/// @param share  as in whose_parts
std::string scaling(double share) { return "scale it by " + rounded_text(1 / share, 2) + " (garment_scale)"; }

std::optional<std::string> unit_text(const Hypothesis& best, const std::optional<double>& share)
{
    if (share && (*share < k_wrong_unit_small || *share > k_wrong_unit_large))
        return whose_parts(*share) + "check its unit (garment_unit), or " + scaling(*share);
    const ClearanceField& cloth = best.attempt->energy().metric().cloth();
    const double length = (cloth.high() - cloth.low()).maxCoeff() / standing_height(best.attempt->rig().skeleton);
    if (length > k_longest_garment || length < k_shortest_garment)
        return "it is " + times(length) + " the body's height long; check its unit (garment_unit)";
    return {};
}

std::string bones_text(const Hypothesis& best)
{
    const FitEnergy& energy = best.attempt->energy();
    const Posture& posture = best.wearing.posture;
    return "of the " + std::to_string(best.attempt->coverage().bones.size()) + " bones that a "
        + std::string(name_of(best.attempt->coverage().type)) + " covers, "
        + std::to_string(bones_inside(energy, posture, k_mostly_inside).size()) + " can be put inside, and "
        + std::to_string(energy.bones_through_cloth(posture))
        + " bones pass through cloth; check that its openings for head, hands, waist and feet are open, and give its "
          "type";
}

}  // namespace

double standing_height(const Skeleton& s)
{
    const auto along = [&s](std::initializer_list<Bone> bones) {
        return std::accumulate(bones.begin(), bones.end(), 0.0, [&s](double sum, Bone b) { return sum + s.length(b); });
    };
    return along({ lowerback, upperback, thorax, lowerneck, upperneck }) + (s.tips[head_top] - s.tail(upperneck)).norm()
        + std::max(along({ lhipjoint, lfemur, ltibia }), along({ rhipjoint, rfemur, rtibia }));
}

std::optional<double> wearer_share(const Skeleton& joints, const std::vector<Opening>& openings)
{
    std::vector<double> heights;
    for (const WearerHeight& wearer : wearer_heights(measures_of(openings)))
        heights.push_back(wearer.height);
    if (heights.empty())
        return {};
    return quantile(heights, 0.5) / standing_height(joints);
}

InvalidInput refusal_of(const Hypothesis& best, const FitOptions& options)
{
    const auto because = [](const std::string& reason) {
        return InvalidInput(ErrorCode::no_fit, "garment: this body does not fit into it: " + reason);
    };
    const std::optional<double> share = wearer_share(best.attempt->rig().skeleton, best.attempt->garment().openings);
    if (const auto unit = unit_text(best, share))
        return because(*unit);
    if (const auto given = given_text(options))
        return { ErrorCode::no_fit, "garment: this body does not fit into it " + *given };
    if (share && *share < k_plainly_small)
        return because(whose_parts(*share) + "it is too small to be put on. Choose a larger size, or "
                       + scaling(*share));
    return because(bones_text(best));
}

InvalidInput refusal_of_empty_legs()
{
    return {
        ErrorCode::no_fit,
        "garment: this body does not fit into it: both its legs stay empty, as the body's legs are too far apart or "
        "too short for them. Choose a wider garment, or scale it (garment_scale)"
    };
}

}  // namespace garmentfit
