// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How probable it is that a garment is worn in some way: this way up, on these bones, facing there.
//
// Method  conditional logit [mcfadden_1974_conditional_logit]: the probability of a hypothesis is proportional to the
//         exponential of its weighted evidence. The evidence of the shape (k_shape_evidence) divides the odds of a
//         coverage between its facings. The weights are fitted on garments of which it is known how they are worn
//         (tuning.h, scripts/fit-evidence).

#include <array>
#include <string_view>
#include <vector>

#include "coverage.h"
#include "fit_energy.h"
#include "place_of_garment.h"

namespace garmentfit {

/// What speaks for a hypothesis, by its best posture. "Leg": length of the body's own, from hip to ankle.
enum Evidence {
    // The pose
    energy_evidence,  ///< m, less the cost of crossings, and without the part that is due to the garment's height
    clearance_evidence,  ///< share of the clearance that covered bones need, 0 to about 1
    uncovered_cloth_evidence,  ///< mean distance of the cloth from the covered limbs, in tenths of a leg
    crossing_evidence,  ///< bones that pass through cloth, at most 3
    covered_inside_evidence,  ///< share of the covered bones that lie inside, arms not beside an empty sleeve
    uncovered_inside_evidence,  ///< share of the other bones, neck apart, that lies inside
    // The way up
    as_given_evidence,  ///< 1 where the garment is held as its file has it, and its openings lie along the vertical
    askew_evidence,  ///< rad, angle to the nearest line from opening to opening, at most 0.5 (WayUp::askew)
    upright_evidence,  ///< of the openings, -1 to 1: for this way up, less that for the same upside down
    // The coverage: 1 for its kind, and what the shape says of it; tops have 0 in all of these
    // but for strapless ones
    legs_evidence,
    skirt_evidence,
    dress_evidence,
    jumpsuit_evidence,
    legs_height_evidence,  ///< logarithm of the garment's height in legs
    skirt_height_evidence,
    dress_height_evidence,
    jumpsuit_height_evidence,
    legs_hems_evidence,  ///< 1 where two openings are those of legs
    skirt_hems_evidence,
    dress_hems_evidence,
    jumpsuit_hems_evidence,
    legs_divided_evidence,  ///< share of the opposite places on both legs, both inside, that have cloth between them
    skirt_divided_evidence,
    dress_divided_evidence,
    jumpsuit_divided_evidence,
    legs_arms_evidence,  ///< 1 where two openings are sleeves or armholes
    skirt_arms_evidence,
    dress_arms_evidence,
    jumpsuit_arms_evidence,
    legs_taper_evidence,  ///< how much wider the top opening is than the cloth below it (taper_of)
    skirt_taper_evidence,
    dress_taper_evidence,
    jumpsuit_taper_evidence,
    strapless_evidence,  ///< 1 for tops that leave the shoulders bare
    strapless_taper_evidence,
    skirt_reach_evidence,  ///< how far it reaches beyond its ends, as sleeves do (reach_of)
    type_evidence,  ///< 1 where it is that of the type guessed by the openings; tops, too
    // The facing
    input_front_evidence,  ///< cosine of the held garment's front to that of the input body: most share a frame
    openings_evidence,  ///< openings that face forwards less those that face backwards (cues_of)
    // FrontShape, less the more askew the garment is held; 0 for k_most_askew
    torso_evidence,  ///< of tops, dresses and jumpsuits
    waist_evidence,  ///< of trousers and skirts
    hems_evidence,
    cuffs_evidence,
    seat_evidence,  ///< of trousers and skirts
    lap_evidence,  ///< of trousers
    rise_evidence,  ///< of trousers and skirts
    bow_evidence,  ///< of tops
    bare_evidence,  ///< of tops, dresses and jumpsuits
    profile_evidence,  ///< profile_of, of dresses and jumpsuits
    near_input_evidence,  ///< 1 where the covered joints lie where a place of the input body has them, 0 a tenth of a leg
    ///< away
    // As it lies: 0 unless the posture is the input pose itself
    in_place_evidence,  ///< 1
    in_place_inside_evidence,  ///< share of the garment's vertices inside the body, at most 0.2, as a multiple of 0.1
    in_place_near_evidence,  ///< share of the cloth near the skin, above k_near_by_chance, as a multiple of 0.1; 0 where
    ///< the file says no place, or the bones inside tell how the garment is worn
    evidence_count
};
/// Evidence that tells the facings of one coverage apart, and nothing else (log_odds).
inline constexpr std::array k_shape_evidence { torso_evidence, waist_evidence, seat_evidence, lap_evidence,
                                               rise_evidence,  bow_evidence,   bare_evidence, profile_evidence };
/// How well the body fits into the garment: from the first to this one.
inline constexpr Evidence k_last_of_pose = uncovered_inside_evidence;
/// From the first to the last: what the garment itself tells of its front. Any of these may be deceived, by a rolled
/// waistband or a low back, so none of them counts for more than k_most_of_a_front (tuning.h).
inline constexpr Evidence k_first_of_garment_front = openings_evidence, k_last_of_garment_front = profile_evidence;
using WearEvidence = std::array<double, evidence_count>;

/// "energy", "clearance", ... in the order of Evidence.
const std::array<std::string_view, evidence_count>& evidence_names();

/// One way in which a garment may be worn.
struct Wearing {
    Posture posture;  ///< in the garment as it is held upright
    bool is_in_place = false;  ///< it is the input pose, in one of the places where the body may stand
    Vec3 front;  ///< unit, of the body; in the garment as it was given
    int rank = 0;  ///< among those that face alike: 0 for the one with most evidence
    WearEvidence evidence {};
};

/// A garment held in one way, with one coverage.
struct WearingContext {
    const FitEnergy& energy;
    const Coverage& coverage;
    Eigen::Quaterniond turn;  ///< that makes the garment upright
    const std::vector<Opening>& openings;  ///< of the held garment
    double taper = 0, reach = 0;  ///< taper_of and reach_of it
    double upright = 0, askew = 0;  ///< of its way up
    const std::vector<BodyPlace>& places;
};

/// The best wearings of each facing among the postures, at most three, best evidence first. Facings less than 60
/// degrees apart are one.
/// @param in_place  those where the garment lies round the body: the input pose there is a posture, too
std::vector<Wearing> wearings_of(const WearingContext& context, const std::vector<Posture>& postures,
                                 const std::vector<BodyPlace>& in_place);

/// But for a constant that all hypotheses of a garment have in common.
double log_odds(const WearEvidence& evidence);
/// The part of it that says how well the body fits into the garment.
double pose_log_odds(const WearEvidence& evidence);
/// Likewise, beside other facings that were searched for the same coverage: most clothes fit a body nearly as well the
/// other way round, so between these the pose counts only k_pose_between_facings of what it counts between coverages.
/// @param best_pose  the most pose_log_odds among the facings
double log_odds(const WearEvidence& evidence, double best_pose);

/// Of hypotheses with these log odds, in the same order; they sum to 1.
std::vector<double> probabilities(const std::vector<double>& log_odds);

}  // namespace garmentfit
