// SPDX-License-Identifier: GPL-3.0-or-later
#include "fast_fit.h"

#include <algorithm>
#include <array>
#include <exception>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "best_start.h"
#include "coordinate_ascent.h"
#include "garmentfit/error.h"
#include "garmentfit/garment_type.h"
#include "garmentfit/number_text.h"
#include "hypotheses.h"
#include "outward_cloth.h"
#include "parallel.h"
#include "posture_moves.h"
#include "refusal.h"
#include "tuning.h"

namespace garmentfit {
namespace {

// Which bone passes through the cloth first, and where.
std::optional<std::string> find_crossing(const FitEnergy& energy, const Posture& posture)
{
    const Skeleton joints = place_bones(energy.rest(), posture).joints;
    const auto crosses = [&](const Vec3& from, const Vec3& to) { return energy.passes_through_cloth(from, to); };
    const auto describe = [](std::string_view name, const Vec3& from, const Vec3& to) {
        return std::string(name) + " passes through it between " + place_text(from) + " and " + place_text(to);
    };
    for (int b = 0; b < bone_count; ++b)
        if (crosses(joints.head(b), joints.tail(b)))
            return describe(bone_name(b), joints.head(b), joints.tail(b));
    if (crosses(joints.tail(upperneck), joints.tips[head_top]))
        return describe("the head", joints.tail(upperneck), joints.tips[head_top]);
    return {};
}

void require_clear(const FitEnergy& energy, const Posture& posture)
{
    if (const std::optional<std::string> crossing = find_crossing(energy, posture))
        throw SolverFailure("no pose found that keeps the bones clear of the cloth: " + *crossing
                            + "; check the garment's type, and that its openings are open");
}

void require_openings(const TriangleMesh& outward, const Skeleton& joints)
{
    const Pieces pieces = count_pieces(outward);
    if (pieces.count > 1 && pieces.largest < k_min_piece)
        throw InvalidInput(ErrorCode::no_opening,
                           "garment: " + std::to_string(pieces.count) + " loose pieces, the largest "
                               + rounded_text(100 * pieces.largest / standing_height(joints), 2)
                               + "% of the body's height across, such as buttons; none of them goes round a body. Give "
                                 "the cloth that they "
                                 "belong to, or check its unit");
    if (is_sealed(outward))
        throw InvalidInput(ErrorCode::closed_garment,
                           "garment: closed surface; a garment needs openings for head, arms or legs. Remove the caps, "
                           "or give another garment");
}

// The best place, refined, along two verticals, in which no bone passes through the cloth: of the posture itself, and of
// one in comfort through the middle of the cloth. The ascent finds neither where bones are deep in the cloth, as each step
// costs as much as none. Legs that are much shorter than those of trousers are drawn down into them until the hips lie in
// the crotch, or both in one leg.
Posture move_clear(const FitEnergy& energy, const Posture& posture)
{
    const Vec3 middle = energy.metric().cloth().barycentre();
    Posture best = posture;
    double best_total = FitEnergy::k_any;
    const auto look_at = [&](const Posture& place) {
        if (const double total = energy.total(place); total > best_total && !find_crossing(energy, place)) {
            best = place;
            best_total = total;
        }
    };
    for (double height = -k_farthest_move; height <= k_farthest_move; height += k_move_step) {
        Posture moved = posture;
        moved.root.y() += height;
        look_at(moved);
        look_at(comfort_posture(energy, middle + Vec3(0, height, 0), posture.turn));
    }
    return best_total > FitEnergy::k_any ? refine_posture(energy, best) : posture;
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

// Trousers that are longer than the legs of the body, and hold none of them: it is too wide for them, and its hips lie
// over their waist or between their legs. Briefs hold no leg either, but they are short.
bool leaves_legs_empty(const Attempt& attempt, const std::vector<Bone>& covered)
{
    const auto is_of_leg = [](Bone b) { return b == lfemur || b == ltibia || b == rfemur || b == rtibia; };
    const ClearanceField& cloth = attempt.energy().metric().cloth();
    const Skeleton& joints = attempt.rig().skeleton;
    return attempt.coverage().kind == CoverageKind::legs && std::none_of(covered.begin(), covered.end(), is_of_leg)
        && (cloth.high() - cloth.low()).y() > joints.length(lfemur) + joints.length(ltibia);
}

// The sum over the hypotheses that agree with one in something.
template <class Agrees>
double probability_of(const std::vector<Hypothesis>& all, const Agrees& agrees)
{
    double sum = 0;
    for (const Hypothesis& hypothesis : all)
        sum += hypothesis.wearing.rank == 0 && agrees(hypothesis) ? hypothesis.probability : 0;
    return std::min(1.0, sum);
}

auto covers_like(const Coverage& coverage)
{
    return [kind = coverage.kind](const Hypothesis& other) { return other.attempt->coverage().kind == kind; };
}

void add_probabilities(FitResult& result, const Hypothesis& chosen, const std::vector<Hypothesis>& all)
{
    const Coverage& coverage = chosen.attempt->coverage();
    result.type_probability = probability_of(all, covers_like(coverage)) * coverage.name_probability;
    result.front_probability = probability_of(
        all, [&](const Hypothesis& other) { return other.wearing.front.dot(chosen.wearing.front) > k_same_direction; });
    result.up_probability
        = probability_of(all, [&](const Hypothesis& other) { return other.up().dot(chosen.up()) > k_same_direction; });
}

// Below upper arms or thighs that are covered on both sides: the forearms or shins of which one is inside and the other
// is not, unless they are inside by their mean. Sleeves are alike: with one cuff in front of the middle of its forearm
// and the other behind it, the arms come out unlike, and pass through cloth where they go.
std::vector<Bone> unlike_bones(const FitEnergy& energy, const Posture& posture)
{
    const Skeleton joints = place_bones(energy.rest(), posture).joints;
    const auto count = [&](Bone b) { return energy.metric().samples_inside(joints.head(b), joints.tail(b)); };
    const auto is_inside = [&](Bone b) { return energy.metric().covers(b) && count(b) >= k_mostly_inside; };
    std::vector<Bone> unlike;
    for (const auto& [left, right, upper_left, upper_right] :
         { std::array { lradius, rradius, lhumerus, rhumerus }, std::array { ltibia, rtibia, lfemur, rfemur } })
        if (is_inside(upper_left) && is_inside(upper_right) && energy.metric().covers(left)
            && energy.metric().covers(right) && is_inside(left) != is_inside(right)
            && count(left) + count(right) < 2 * k_mostly_inside)
            unlike.insert(unlike.end(), { left, right });
    return unlike;
}

// The pose of a hypothesis. @throws InvalidInput when no body fits in like that; SolverFailure when bones pass through
// cloth in the end
// @param moves  whether bones that pass through cloth are looked for another place
// @param inside  the bones that are taken to be covered
FitResult finish(const Hypothesis& hypothesis, const FitOptions& options, bool moves, const std::vector<Bone>& inside)
{
    const Attempt& attempt = *hypothesis.attempt;
    const Posture& start = hypothesis.wearing.posture;
    const BoneMetric metric(attempt.energy().metric().cloth(), limb_radii_of(attempt.rig(), inside));
    const FitEnergy energy(attempt.rig(), attempt.limits(), metric, attempt.cues()),
        thick(attempt.rig(), attempt.limits(), metric, attempt.cues(), k_bone_thickness);
    const bool keeps_input = hypothesis.wearing.is_in_place && !find_crossing(thick, start);
    Posture fitted = keeps_input ? start : ascend_fully(energy, start, attempt.garment().outward);
    if (const std::vector<Bone> unlike = unlike_bones(energy, fitted); !keeps_input && !unlike.empty()) {
        std::vector<Bone> alike = inside;
        std::erase_if(alike, [&](Bone b) { return std::find(unlike.begin(), unlike.end(), b) != unlike.end(); });
        return finish(hypothesis, options, moves, alike);
    }
    // The ascent may end with a bone that all but touches the cloth: no body can grow from there.
    if (find_crossing(thick, fitted))
        fitted = refine_posture(thick, fitted);
    if (moves && find_crossing(thick, fitted))
        fitted = move_clear(thick, fitted);
    require_clear(thick, fitted);

    FitResult result;
    result.type = attempt.coverage().type;
    result.probability = hypothesis.probability;
    result.up = hypothesis.up();
    result.front = hypothesis.wearing.front;
    result.covered = bones_inside(energy, fitted, k_mostly_inside);
    if (result.covered.empty())  // straps and a band: it lies round the body all the same
        result.covered = inside;
    if (leaves_legs_empty(attempt, result.covered))
        throw refusal_of_empty_legs();
    result.pose = pose_of(attempt.rig().skeleton, rotate(fitted, attempt.garment().turn.conjugate()));
    result.scores = energy.bone_scores(fitted);
    result.clearance = metric.clearance_shares(place_bones(attempt.rig().skeleton, fitted).joints);
    result.scores_before = energy.bone_scores(start_at_barycentre(energy));
    return result;
}

// The type may name bones that are not inside, such as the forearm of a short sleeve: they are not covered.
FitResult finish(const Hypothesis& hypothesis, const FitOptions& options, bool moves)
{
    if (!hypothesis.is_possible())
        throw refusal_of(hypothesis, options);
    const std::vector<Bone> inside
        = bones_inside(hypothesis.attempt->energy(), hypothesis.wearing.posture, k_partly_inside);
    return finish(hypothesis, options, moves, inside.empty() ? hypothesis.attempt->coverage().bones : inside);
}

// The most probable hypothesis in which a body fits, FitOptions::skipped of those left out.
FitResult choose(const std::vector<Hypothesis>& all, const FitOptions& options, bool moves)
{
    std::vector<Rejected> rejected;
    std::exception_ptr first;
    const auto reject = [&](const Hypothesis& hypothesis, const std::string& reason) {
        if (!first)
            first = std::current_exception();
        rejected.push_back({ hypothesis.attempt->coverage().type, hypothesis.up(), hypothesis.wearing.front,
                             hypothesis.probability, reason });
    };
    std::vector<const Hypothesis*> done;  // ways in which the body fits, and that are skipped
    for (const Hypothesis& hypothesis : all)
        try {
            if (first && hypothesis.probability < k_improbable)
                break;  // it would be worn wrongly: better to say why it is not worn as it should
            if (std::any_of(done.begin(), done.end(),
                            [&](const Hypothesis* other) { return is_same_way(*other, hypothesis); }))
                continue;
            FitResult result = finish(hypothesis, options, moves);
            if (int(done.size()) < options.skipped) {
                done.push_back(&hypothesis);
                continue;
            }
            add_probabilities(result, hypothesis, all);
            result.rejected = rejected;
            return result;
        } catch (const InvalidInput& error) {
            reject(hypothesis, error.what());
        } catch (const SolverFailure& error) {
            reject(hypothesis, error.what());
        }
    if (!first)
        throw InvalidInput(ErrorCode::no_fit, "garment: there is no other way in which the body fits into it");
    std::rethrow_exception(first);
}

// A body whose bones pass through the cloth in all ways of wearing it is moved, but only in garments of the type that the
// user or the openings say, or of a kind that is more probable than all others: a wrong type may be why they pass
// through it.
FitResult choose(const std::vector<Hypothesis>& all, const GarmentMesh& garment, const FitOptions& options)
{
    std::exception_ptr refusal;
    try {
        return choose(all, options, false);
    } catch (const SolverFailure&) {
        if (options.skipped > 0)  // there is one way already
            throw;
        refusal = std::current_exception();
    }
    std::vector<Hypothesis> likely = all;
    if (options.type == GarmentType::automatic)
        std::erase_if(likely, [&, guessed = guess_garment_type(garment).type](const Hypothesis& hypothesis) {
            const Coverage& coverage = hypothesis.attempt->coverage();
            return coverage.type != guessed && !(probability_of(all, covers_like(coverage)) > k_likely);
        });
    try {
        return choose(likely, options, true);
    } catch (const InvalidInput&) {
        std::rethrow_exception(refusal);
    } catch (const SolverFailure&) {
        std::rethrow_exception(refusal);
    }
}

}  // namespace

FitResult fit_fast(const Rig& rig, const TriangleMesh& body, const GarmentMesh& garment, const FitOptions& options,
                   const Progress& progress)
{
    const Progress stage = progress.part(0, 1, "fit the skeleton");
    const TriangleMesh outward = outward_cloth(garment);
    require_openings(outward, rig.skeleton);
    if (options.as_placed && body.positions.rows() == 0)
        throw InvalidInput(ErrorCode::wrong_call, "as_placed: the fit needs the body's surface for it; give the body");
    const std::vector<Hypothesis> hypotheses = find_hypotheses(rig, body, outward, options, stage.part(0, 0.8));
    stage.at(0.8);
    if (options.as_placed && hypotheses.empty())
        throw InvalidInput(ErrorCode::no_fit,
                           "garment: it does not lie round the body; leave as_placed out, or check the garment's unit "
                           "and axes");
    if (options.front && hypotheses.empty())
        throw InvalidInput(
            ErrorCode::no_fit,
            "garment: no body that faces as its front was given fits into it; check the front, or leave it "
            "out and let the program find it");
    FitResult result = choose(hypotheses, garment, options);
    result.front_given = options.front;
    if (result.type != options.type)
        result.type = type_when_worn(result.type, result.covered);
    return result;
}

}  // namespace garmentfit
