// SPDX-License-Identifier: GPL-3.0-or-later
#include "evidence.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "front_shape.h"
#include "posture_moves.h"
#include "tuning.h"
#include "way_up.h"

namespace garmentfit {
namespace {

// Of the joints at both ends of the covered bones from those of the input body, shifted, m.
double mean_distance(const FitEnergy& energy, const Skeleton& fitted, const Vec3& shift)
{
    double sum = 0;
    int joints = 0;
    for (int b = 0; b < bone_count; ++b)
        if (energy.metric().covers(b)) {
            sum += (fitted.head(b) - energy.rest().head(b) - shift).norm()
                + (fitted.tail(b) - energy.rest().tail(b) - shift).norm();
            joints += 2;
        }
    return sum / std::max(joints, 1);
}

// In tenths of a leg, from the nearest place of the input body.
double distance_from_input(const WearingContext& context, const Posture& posture, double leg)
{
    const Skeleton fitted = place_bones(context.energy.rest(), posture).joints;
    double least = mean_distance(context.energy, fitted, Vec3::Zero());
    for (const BodyPlace& place : context.places)
        least = std::min(least, mean_distance(context.energy, fitted, place.shift));
    return least / (k_tenth * leg);
}

struct InsideShares {
    double covered = 0, uncovered = 0;
};

InsideShares shares_inside(const FitEnergy& energy, const Posture& posture)
{
    const Skeleton joints = place_bones(energy.rest(), posture).joints;
    InsideShares sum;
    int covered = 0, uncovered = 0;
    for (int b = 0; b < bone_count; ++b) {
        const int samples = energy.metric().samples_inside(joints.head(b), joints.tail(b));
        if (energy.metric().covers(b)) {
            sum.covered += samples >= k_mostly_inside && !energy.misses_sleeve(b, joints.tail(b), joints);
            ++covered;
        } else if (b != lowerneck && b != upperneck) {
            sum.uncovered += double(samples) / k_samples;
            ++uncovered;
        }
    }
    return { sum.covered / std::max(covered, 1), sum.uncovered / std::max(uncovered, 1) };
}

// Trousers have cloth between the legs, skirts have none; whether there is an opening at each foot or not.
double share_divided(const FitEnergy& energy, const Skeleton& joints)
{
    const ClearanceField& cloth = energy.metric().cloth();
    int inside = 0, divided = 0;
    for (const auto& [left, right] : { std::pair(lfemur, rfemur), std::pair(ltibia, rtibia) })
        for (int i = 0; i < k_samples; ++i) {
            const Vec3 on_left = bone_sample(joints.head(left), joints.tail(left), i),
                       on_right = bone_sample(joints.head(right), joints.tail(right), i);
            if (!cloth.at(on_left).is_inside() || !cloth.at(on_right).is_inside())
                continue;
            ++inside;
            divided += cloth.crosses(on_left, on_right);
        }
    return double(divided) / std::max(inside, 1);
}

// @param in_place  where the posture is the input pose; null for any other one
WearEvidence evidence_of(const WearingContext& context, const Posture& posture, const BodyPlace* in_place)
{
    const FitEnergy& energy = context.energy;
    const ClearanceField& cloth = energy.metric().cloth();
    const Skeleton &rest = energy.rest(), worn = place_bones(rest, posture).joints;
    const double leg = rest.length(lfemur) + rest.length(ltibia);
    const InsideShares inside = shares_inside(energy, posture);
    const Posture given = rotate(posture, context.turn.conjugate());
    const Vec3 upright_front = posture.turn * energy.rig().front;
    const Vec3 level = Vec3(upright_front.x(), 0, upright_front.z()).stableNormalized();

    WearEvidence e {};
    e[energy_evidence] = energy.total(posture) - energy.hang_slope() * cloth.barycentre().y();
    e[clearance_evidence] = energy.clearance_share(posture);
    e[uncovered_cloth_evidence] = energy.mean_coverage_distance(posture) / (k_tenth * leg);
    e[crossing_evidence] = std::min(energy.bones_through_cloth(posture), k_max_crossing_evidence);
    e[covered_inside_evidence] = inside.covered;
    e[uncovered_inside_evidence] = inside.uncovered;
    e[as_given_evidence] = context.turn.w() == 1 ? 1 - context.askew / k_most_askew : 0;
    e[askew_evidence] = context.askew;
    e[upright_evidence] = context.upright;
    e[type_evidence] = context.coverage.is_guessed;
    if (const int kind = int(context.coverage.kind) - 1; kind >= 0) {
        e[legs_evidence + kind] = 1;
        e[legs_height_evidence + kind] = std::log((cloth.high().y() - cloth.low().y()) / leg);
        e[legs_hems_evidence + kind] = !energy.cues().hems.empty();
        e[legs_divided_evidence + kind] = share_divided(energy, worn);
        e[legs_arms_evidence + kind] = energy.cues().has_arms;
        e[legs_taper_evidence + kind] = context.taper;
    }
    if (context.coverage.type == GarmentType::strapless) {
        e[strapless_evidence] = 1;
        e[strapless_taper_evidence] = context.taper;
    }
    e[skirt_reach_evidence] = context.coverage.kind == CoverageKind::skirt ? context.reach : 0;
    e[input_front_evidence] = upright_front.dot(energy.rig().front);
    e[openings_evidence] = std::clamp(level.dot(energy.cues().front), -k_max_opening_evidence, k_max_opening_evidence);
    const FrontShape shape = front_shape(cloth.patches(), context.openings, energy.cues(), level);
    const bool is_bottom = context.coverage.kind == CoverageKind::legs || context.coverage.kind == CoverageKind::skirt;
    const double held = 1 - context.askew / k_most_askew;  // heights of a garment held askew are no heights
    e[is_bottom ? waist_evidence : torso_evidence] = held * (is_bottom ? shape.waist : shape.torso);
    e[hems_evidence] = held * shape.hems;
    e[cuffs_evidence] = held * shape.cuffs;
    e[seat_evidence] = is_bottom ? held * shape.seat : 0;
    e[lap_evidence] = is_bottom && !energy.cues().hems.empty() ? held * shape.lap : 0;
    e[rise_evidence] = is_bottom ? held * shape.rise : 0;
    e[bow_evidence] = context.coverage.kind == CoverageKind::top ? held * shape.bow : 0;
    e[bare_evidence] = is_bottom || energy.cues().is_halter ? 0 : held * shape.bare;  // halters are bare behind
    if (context.coverage.kind == CoverageKind::dress || context.coverage.kind == CoverageKind::jumpsuit)
        e[profile_evidence] = held * profile_of(cloth.patches(), worn, level);
    e[in_place_evidence] = in_place != nullptr;
    e[in_place_inside_evidence] = in_place ? std::min(in_place->inside_share, k_max_inside_evidence) / k_tenth : 0;
    e[in_place_near_evidence] = in_place ? std::max(0.0, in_place->near_share - k_near_by_chance) / k_tenth : 0;
    e[near_input_evidence] = std::exp(-distance_from_input(context, given, leg));
    return e;
}

// In log odds.
double counted(const WearEvidence& evidence, Evidence e)
{
    static_assert(k_evidence_weights.size() == evidence_count);
    const double weighted = k_evidence_weights[e] * evidence[e];
    const bool is_bounded = e >= k_first_of_garment_front && e <= k_last_of_garment_front;
    return is_bounded ? std::clamp(weighted, -k_most_of_a_front, k_most_of_a_front) : weighted;
}

bool is_same_facing(const Wearing& a, const Wearing& b) { return a.front.dot(b.front) > k_same_direction; }

}  // namespace

const std::array<std::string_view, evidence_count>& evidence_names()
{
    static constexpr std::array<std::string_view, evidence_count> names {
        "energy",
        "clearance",
        "uncovered_cloth",
        "crossing",
        "covered_inside",
        "uncovered_inside",
        "as_given",
        "askew",
        "upright",
        "legs",
        "skirt",
        "dress",
        "jumpsuit",
        "legs_height",
        "skirt_height",
        "dress_height",
        "jumpsuit_height",
        "legs_hems",
        "skirt_hems",
        "dress_hems",
        "jumpsuit_hems",
        "legs_divided",
        "skirt_divided",
        "dress_divided",
        "jumpsuit_divided",
        "legs_arms",
        "skirt_arms",
        "dress_arms",
        "jumpsuit_arms",
        "legs_taper",
        "skirt_taper",
        "dress_taper",
        "jumpsuit_taper",
        "strapless",
        "strapless_taper",
        "skirt_reach",
        "type",
        "input_front",
        "openings",
        "torso",
        "waist",
        "hems",
        "cuffs",
        "seat",
        "lap",
        "rise",
        "bow",
        "bare",
        "profile",
        "near_input",
        "in_place",
        "in_place_inside",
        "in_place_near",
    };
    return names;
}

std::vector<Wearing> wearings_of(const WearingContext& context, const std::vector<Posture>& postures,
                                 const std::vector<BodyPlace>& in_place)
{
    std::vector<Wearing> all;
    const auto add = [&](const Posture& posture, const BodyPlace* place) {
        const Vec3 front = context.turn.conjugate() * (posture.turn * context.energy.rig().front);
        all.push_back({ posture, place != nullptr, front, 0, evidence_of(context, posture, place) });
    };
    for (const Posture& posture : postures)
        add(posture, nullptr);
    for (const BodyPlace& place : in_place)
        add(input_posture(context.energy.rest(), place.shift), &place);
    std::stable_sort(all.begin(), all.end(),
                     [](const Wearing& a, const Wearing& b) { return log_odds(a.evidence) > log_odds(b.evidence); });
    std::vector<Wearing> best;
    for (Wearing& wearing : all) {
        // of two that face alike with a third one, that one decides: they need not face alike
        const auto first = std::find_if(best.begin(), best.end(), [&](const Wearing& other) {
            return other.rank == 0 && is_same_facing(wearing, other);
        });
        if (first != best.end())
            wearing.rank = int(std::count_if(best.begin(), best.end(),
                                             [&](const Wearing& other) { return is_same_facing(*first, other); }));
        if (wearing.rank < k_wearings_of_a_facing)
            best.push_back(wearing);
    }
    return best;
}

// The evidence of the shape is s for one facing and about -s for the opposite one. exp(s) / (exp(s) + exp(-s)) divides
// the odds of a coverage between its facings; without the denominator a marked shape would raise those odds, too.
double log_odds(const WearEvidence& evidence)
{
    double all = 0, shape = 0;
    for (int e = 0; e < evidence_count; ++e)
        all += counted(evidence, Evidence(e));
    for (const Evidence e : k_shape_evidence)
        shape += counted(evidence, e);
    return all - std::abs(shape) - std::log1p(std::exp(-2 * std::abs(shape)));
}

double pose_log_odds(const WearEvidence& evidence)
{
    double sum = 0;
    for (int e = 0; e <= k_last_of_pose; ++e)
        sum += counted(evidence, Evidence(e));
    return sum;
}

double log_odds(const WearEvidence& evidence, double best_pose)
{
    return log_odds(evidence) + (1 - k_pose_between_facings) * (best_pose - pose_log_odds(evidence));
}

std::vector<double> probabilities(const std::vector<double>& log_odds)
{
    std::vector<double> result;
    if (log_odds.empty())
        return result;
    const double most = *std::max_element(log_odds.begin(), log_odds.end());
    for (const double one : log_odds)
        result.push_back(std::exp(one - most));
    const double sum = std::accumulate(result.begin(), result.end(), 0.0);
    for (double& one : result)
        one /= sum;
    return result;
}

}  // namespace garmentfit
