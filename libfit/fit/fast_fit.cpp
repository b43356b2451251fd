// SPDX-License-Identifier: GPL-3.0-or-later
#include "fast_fit.h"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "best_start.h"
#include "coordinate_ascent.h"
#include "garmentfit/error.h"
#include "number_text.h"
#include "outward_cloth.h"
#include "parallel.h"
#include "posture_moves.h"
#include "type_guess.h"
#include "way_up.h"

namespace garmentfit {
namespace {

// The covered bones that have at least so many of their five samples inside.
std::vector<Bone> bones_inside(const FitEnergy& energy, const Posture& posture, int samples)
{
    const Skeleton joints = place_bones(energy.rest(), posture).joints;
    std::vector<Bone> inside;
    for (int b = 0; b < bone_count; ++b)
        if (energy.metric().covers(b) && energy.metric().samples_inside(joints.head(b), joints.tail(b)) >= samples)
            inside.push_back(Bone(b));
    return inside;
}

std::string describe_sizes(const Rig& rig, const ClearanceField& cloth)
{
    const Vec3 size = 100 * (cloth.high() - cloth.low());
    const Skeleton& rest = rig.skeleton;
    return "the garment is " + rounded_text(size.x(), 3) + " x " + rounded_text(size.y(), 3) + " x "
        + rounded_text(size.z(), 3) + " cm, the body's legs are "
        + rounded_text(100 * (rest.length(lfemur) + rest.length(ltibia)), 3) + " cm long";
}

// Half of the covered bones must be inside, with some clearance: next to a flat sheet everything is half inside. The
// refinement may free one bone from the cloth; among scraps of cloth it cannot.
void require_fit(const FitEnergy& energy, const Posture& posture, const std::string& sizes)
{
    const std::vector<Bone> inside = bones_inside(energy, posture, k_mostly_inside);
    const auto& covered_bones = energy.metric().limbs().covered;
    const auto covered = std::size_t(std::count(covered_bones.begin(), covered_bones.end(), true));
    const int crossing = energy.bones_through_cloth(posture);
    if (2 * inside.size() < covered || energy.clearance_share(posture) < k_min_clearance_share
        || crossing > k_max_crossing_bones)
        throw InvalidInput(ErrorCode::no_fit,
                           "garment: no pose brings the body into it: of the " + std::to_string(covered)
                               + " bones that it should cover, " + std::to_string(inside.size())
                               + " can be put inside, and " + std::to_string(crossing) + " bones pass through cloth; "
                               + sizes + "; check the garment's unit and give its type");
}

void require_clear(const FitEnergy& energy, const Posture& posture)
{
    const Skeleton joints = place_bones(energy.rest(), posture).joints;
    const auto require = [&](const std::string& name, const Vec3& from, const Vec3& to) {
        if (!energy.metric().cloth().crosses(from, to))
            return;
        throw SolverFailure("no pose found that keeps the bones clear of the cloth: " + name
                            + " passes through it between " + place_text(from) + " and " + place_text(to)
                            + "; check the garment's type, and that its openings are open");
    };
    for (int b = 0; b < bone_count; ++b)
        require(std::string(bone_name(b)), joints.head(b), joints.tail(b));
    require("the head", joints.tail(upperneck), joints.tips[head_top]);
}

void require_openings(const TriangleMesh& outward)
{
    const Pieces pieces = count_pieces(outward);
    if (pieces.count > 1 && pieces.largest < k_min_piece)
        throw InvalidInput(
            ErrorCode::no_opening,
            "garment: " + std::to_string(pieces.count) + " loose pieces, the largest "
                + rounded_text(100 * pieces.largest, 3)
                + " cm across, such as buttons; none of them goes round a body. Give the cloth that they "
                  "belong to, or check its unit");
    if (is_sealed(outward))
        throw InvalidInput(ErrorCode::closed_garment,
                           "garment: closed surface; a garment needs openings for head, arms or legs. Remove the caps, "
                           "or give another garment");
}

// The start of [wu_2018_garment_fitting]: the root at the barycentre of the garment.
Posture start_at_barycentre(const FitEnergy& energy)
{
    return comfort_posture(energy, energy.metric().cloth().barycentre(), upright_turn(energy.rig(), 0));
}

// In tight cloth the energy alone decides. In wider cloth the paper's E counts too, and where covered bones have nearly
// all the clearance that they need, it decides alone.
Posture ascend_where_wide(const FitEnergy& energy, const Posture& posture, IncrementalPaperMetric& paper)
{
    const double before = energy.clearance_share(posture);
    if (before < k_share_tight)
        return posture;
    // Large steps may go on where the small steps of the first ascent ended.
    const Posture first = ascend_with_paper(energy, posture, paper, k_paper_steps),
                  second = ascend_with_paper(energy, first, paper, k_paper_large_steps);
    const double after = energy.clearance_share(second);
    if (after < before - k_share_given_up)
        return posture;
    return after < k_share_wide ? second : ascend_by_paper(energy, second, paper, k_paper_near_steps);
}

// By the energy, then by the paper's E, whose metric is built meanwhile.
Posture ascend_fully(const FitEnergy& energy, const Posture& start, const TriangleMesh& outward)
{
    std::optional<Posture> posture;
    std::optional<IncrementalPaperMetric> paper;
    parallel_for<int>(2, [&](int part) {
        if (part == 0)
            posture = refine_posture(energy, start);
        else
            paper.emplace(outward, energy.metric().limbs().covered);
    });
    return ascend_where_wide(energy, *posture, *paper);
}

// A garment in one orientation.
struct OrientedGarment {
    TriangleMesh outward;
    std::vector<Opening> openings;
    std::unique_ptr<const ClearanceField> clearance;
};

OrientedGarment measure_garment(const TriangleMesh& outward)
{
    OrientedGarment result { outward, {}, {} };
    parallel_for<int>(2, [&](int part) {
        if (part == 0)
            result.clearance = std::make_unique<const ClearanceField>(outward);
        else
            result.openings = openings_of(outward);
    });
    return result;
}

OrientedGarment rotate(const OrientedGarment& garment, const Eigen::Quaterniond& turn)
{
    OrientedGarment result { rotate(garment.outward, turn), {}, {} };
    result.openings = rotate(garment.openings, result.outward, turn);
    result.clearance = std::make_unique<const ClearanceField>(result.outward);
    return result;
}

// One way up of a garment, and the best start of the body in it.
class Attempt {
public:
    /// @throws InvalidInput when no body fits into the garment held like this.
    Attempt(const Rig& rig, OrientedGarment garment, GarmentType given, const Progress& progress) :
        rig_(rig), garment_(std::move(garment)), cloth_(*garment_.clearance),
        guess_(resolve_type(given, garment_.openings)), cues_(cues_of(garment_.openings)), limits_(rig),
        metric_(cloth_, limb_radii_of(rig, bones_covered_by(guess_.type, garment_.openings))),
        energy_(rig_, limits_, metric_, cues_), start_(find_best_start(energy_, facing_hypotheses(energy_), progress))
    {
        require_fit(energy_, start_.posture, describe_sizes(rig_, cloth_));
    }

    /// The energy without the part that is due to the height of the garment, m.
    double merit() const { return energy_.total(start_.posture) - energy_.hang_slope() * cloth_.barycentre().y(); }

    /// @param back  rotates the garment back to how it was given
    FitResult finish(const Eigen::Quaterniond& back) const
    {
        // The type may name bones that are not inside, such as the forearm of a short sleeve: they are not covered.
        const BoneMetric metric(cloth_, limb_radii_of(rig_, bones_inside(energy_, start_.posture, k_partly_inside)));
        const FitEnergy energy(rig_, limits_, metric, cues_);
        const Posture fitted = ascend_fully(energy, start_.posture, garment_.outward);
        require_clear(energy, fitted);

        FitResult result;
        result.type = guess_.type;
        result.type_margin = guess_.margin;
        result.front_probability = start_.front_probability;
        result.covered = bones_inside(energy, fitted, k_mostly_inside);
        result.pose = pose_of(rig_.skeleton, rotate(fitted, back));
        result.scores = energy.bone_scores(fitted);
        result.clearance = metric.clearance_shares(place_bones(rig_.skeleton, fitted).joints);
        result.scores_before = energy.bone_scores(start_at_barycentre(energy));
        return result;
    }

private:
    const Rig& rig_;
    OrientedGarment garment_;
    const ClearanceField& cloth_;
    TypeGuess guess_;
    GarmentCues cues_;
    JointLimits limits_;
    BoneMetric metric_;
    FitEnergy energy_;
    BestStart start_;
};

struct RankedAttempt {
    std::unique_ptr<const Attempt> attempt;
    Eigen::Quaterniond turn;
    double merit = 0;  // m
    double evidence = 0;  // of the openings for this way up
    double margin = 1;  // 0 (another way up is as good) to 1

    Vec3 up() const { return turn.conjugate() * Vec3::UnitY(); }
};

bool is_as_given(const WayUp& way) { return way.turn.w() == 1; }

// What the openings tell is worth that much energy, m.
double prior_of(const WayUp& way)
{
    return is_as_given(way) && way.evidence <= 0 ? k_prior_as_given : k_evidence_for_up * way.evidence;
}

bool has_evidence(const RankedAttempt& best) { return best.attempt && best.evidence > 0; }

// How much better the best is than any other way up, 0 to 1.
double margin_of(const RankedAttempt& best, const std::vector<std::pair<Vec3, double>>& merits)
{
    double margin = 1;
    for (const auto& [up, merit] : merits)
        if (up.dot(best.up()) < k_same_way_up)
            margin = std::min(margin, (best.merit - merit) / k_clear_up);
    return std::max(0.0, margin);
}

// The way up with the greatest merit, of those with evidence; of the others only where no body fits in those.
RankedAttempt choose_way_up(const Rig& rig, const OrientedGarment& garment, const std::vector<WayUp>& ways,
                            GarmentType given, const Progress& progress)
{
    RankedAttempt best;
    std::vector<std::pair<Vec3, double>> merits;
    std::optional<InvalidInput> refusal;
    for (std::size_t i = 0; i < ways.size() && (ways[i].evidence > 0 || !has_evidence(best)); ++i) {
        const double from = double(i) / double(ways.size());
        try {
            auto attempt
                = std::make_unique<const Attempt>(rig, rotate(garment, ways[i].turn), given, progress.part(from, from));
            const double merit = attempt->merit() + prior_of(ways[i]);
            merits.emplace_back(ways[i].turn.conjugate() * Vec3::UnitY(), merit);
            if (!best.attempt || merit > best.merit)
                best = { std::move(attempt), ways[i].turn, merit, ways[i].evidence };
        } catch (const InvalidInput& error) {
            if (!refusal)
                refusal = error;
        }
    }
    if (!best.attempt)
        throw *refusal;
    best.margin = std::min(margin_of(best, merits), best.evidence > 0 ? best.evidence : 1);
    return best;
}

RankedAttempt find_way_up(const Rig& rig, const TriangleMesh& outward, GarmentType given, const Progress& progress)
{
    OrientedGarment garment = measure_garment(outward);
    const std::vector<WayUp> ways = ways_up(outward, garment.openings);
    if (ways.size() > 1)
        return choose_way_up(rig, garment, ways, given, progress);
    return { std::make_unique<const Attempt>(rig, std::move(garment), given, progress), ways[0].turn, 0,
             ways[0].evidence, ways[0].evidence };
}

}  // namespace

FitResult fit_fast(const Rig& rig, const GarmentMesh& garment, GarmentType given, const Progress& progress)
{
    const Progress stage = progress.part(0, 1, "fit the skeleton");
    const TriangleMesh outward = outward_cloth(garment);
    require_openings(outward);
    const RankedAttempt best = find_way_up(rig, outward, given, stage.part(0, 0.8));
    stage.at(0.8);
    FitResult result = best.attempt->finish(best.turn.conjugate());
    result.up = best.up();
    result.up_margin = best.margin;
    return result;
}

}  // namespace garmentfit
