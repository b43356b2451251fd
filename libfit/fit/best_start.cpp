// SPDX-License-Identifier: GPL-3.0-or-later
#include "best_start.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>

#include <Eigen/Eigenvalues>

#include "coordinate_ascent.h"
#include "limb_search.h"
#include "parallel.h"
#include "posture_moves.h"

namespace garmentfit {
namespace {

struct Candidate {
    Posture posture;
    double score = 0;  // m
};
using Candidates = std::vector<Candidate>;

void sort_best_first(Candidates& candidates)
{
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
}

bool covers_first_bone(const FitEnergy& energy, const Limb& limb) { return energy.metric().covers(limb.bones[0]); }

bool covers_both_bones(const FitEnergy& energy, const Limb& limb)
{
    return energy.metric().covers(limb.bones[0]) && energy.metric().covers(limb.bones[1]);
}

// ---------------------------------------------------------------- facings

// The horizontal direction in which the cloth is spread most.
Eigen::Vector2d widest_direction(const ClearanceField& cloth)
{
    Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
    for (const ClothPatch& patch : cloth.patches()) {
        const Vec3 from_middle = patch.centre.cast<double>() - cloth.barycentre();
        const Eigen::Vector2d level(from_middle.x(), from_middle.z());
        spread += level * level.transpose();
    }
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(spread).eigenvectors().col(1);
}

// From sleeve to sleeve or from leg to leg, or else as the cloth is spread.
double heading_across(const FitEnergy& energy)
{
    const Vec3& across = energy.cues().across;
    const Eigen::Vector2d level
        = across.isZero() ? widest_direction(energy.metric().cloth()) : Eigen::Vector2d(across.x(), across.z());
    return std::atan2(-level.y(), level.x());
}

double angle_apart(double a, double b) { return std::abs(std::remainder(a - b, 2 * std::numbers::pi)); }

// Rotations of the input body about the vertical, rad. A heading close to the input body's is replaced by it.
std::vector<double> candidate_headings(const FitEnergy& energy)
{
    const Vec3 left = energy.rig().up.cross(energy.rig().front);
    const double input = std::atan2(-left.z(), left.x()), across = heading_across(energy) - input;
    const bool cues_tell = !energy.cues().across.isZero();
    std::vector<double> headings;
    for (int quarter = 0; quarter < 4; quarter += cues_tell ? 2 : 1) {
        const double heading = across + quarter * std::numbers::pi / 2;
        headings.push_back(angle_apart(heading, 0) > k_same_heading ? heading : 0);
    }
    if (!cues_tell && std::find(headings.begin(), headings.end(), 0.0) == headings.end())
        headings.push_back(0);
    std::stable_partition(headings.begin(), headings.end(), [](double heading) { return heading == 0; });
    return headings;
}

bool face_apart(const Rig& rig, const Posture& a, const Posture& b)
{
    return (a.turn * rig.front).dot(b.turn * rig.front) < 0;
}

// ---------------------------------------------------------------- stages

Posture search_covered_limbs(const FitEnergy& energy, Posture posture, const LimbGrid& grid)
{
    for (const Limb& limb : k_limbs)
        if (covers_first_bone(energy, limb))
            posture = search_limb(energy, posture, limb, grid);
    return posture;
}

// First stage: places of the trunk for each hypothesis, with limbs by a coarse search.
Candidates find_places(const FitEnergy& energy, const MinMaxPyramid& clearance,
                       const std::vector<StartHypothesis>& hypotheses)
{
    std::vector<Posture> postures;
    for (const StartHypothesis& hypothesis : hypotheses)
        postures.push_back(comfort_posture(energy, Vec3::Zero(), hypothesis.turn));
    std::vector<std::vector<Place>> places(postures.size());
    parallel_for<std::size_t>(postures.size(),
                              [&](std::size_t h) { places[h] = find_trunk_places(energy, clearance, postures[h]); });
    Candidates candidates;
    for (std::size_t h = 0; h < postures.size(); ++h)
        for (const Place& place : places[h]) {
            candidates.push_back({ postures[h] });
            candidates.back().posture.root = place.at;
        }
    parallel_for<std::size_t>(candidates.size(), [&](std::size_t i) {
        candidates[i].posture = search_covered_limbs(energy, candidates[i].posture, k_coarse_grid);
        candidates[i].score = energy.value(candidates[i].posture);
    });
    return candidates;
}

// The best `count`, no two alike: the ascent would make those one.
Candidates keep_distinct(Candidates candidates, std::size_t count)
{
    sort_best_first(candidates);
    Candidates kept;
    for (const Candidate& candidate : candidates) {
        const bool is_new = std::none_of(kept.begin(), kept.end(), [&](const Candidate& other) {
            return (candidate.posture.root - other.posture.root).norm() < k_places_apart
                && candidate.posture.turn.angularDistance(other.posture.turn) < k_same_heading;
        });
        if (is_new && kept.size() < count)
            kept.push_back(candidate);
    }
    return kept;
}

// Second stage: limbs on the wide grid. The ascent may free bones from the cloth, so crossings cost less before it.
void search_limbs_widely(const FitEnergy& energy, Candidates& candidates)
{
    parallel_for<std::size_t>(candidates.size(), [&](std::size_t i) {
        const Posture posture = search_covered_limbs(energy, candidates[i].posture, k_wide_grid);
        candidates[i] = { posture, energy.value(posture) - k_early_crossing * energy.crossing_cost(posture) };
    });
}

std::vector<Posture> postures_of(const Candidates& candidates)
{
    std::vector<Posture> postures;
    for (const Candidate& candidate : candidates)
        postures.push_back(candidate.posture);
    return postures;
}

// Third stage: all degrees of freedom together. The refinement frees hands and feet, so their crossings still cost
// less.
void ascend_roughly(const FitEnergy& energy, Candidates& candidates)
{
    parallel_for<std::size_t>(candidates.size(), [&](std::size_t i) {
        const Posture posture = ascend(energy, candidates[i].posture, k_rough_steps);
        candidates[i] = { posture, energy.total(posture) + (1 - k_early_crossing) * energy.tip_crossing_cost(posture) };
    });
}

// ---------------------------------------------------------------- what the third stage looks at

// The best but for bones that pass through cloth, if that makes a clear difference.
std::optional<Posture> find_promising(const FitEnergy& energy, const std::vector<Posture>& sorted)
{
    const auto most = std::max_element(sorted.begin(), sorted.end(), [&](const Posture& a, const Posture& b) {
        return energy.value(a) < energy.value(b);
    });
    const bool is_promising = energy.value(*most) > energy.value(sorted[0]) + k_promising;
    return is_promising ? std::optional<Posture>(*most) : std::nullopt;
}

// The best start, the best that faces the other way, the best rotated by half a turn, because most garments have as
// much clearance then, and the best that faces as the input body does.
std::vector<Posture> choose_for_ascent(const FitEnergy& energy, const std::vector<Posture>& sorted)
{
    if (sorted.empty())
        return {};
    std::vector<Posture> chosen { sorted[0] };
    const auto other = std::find_if(sorted.begin(), sorted.end(),
                                    [&](const Posture& s) { return face_apart(energy.rig(), s, sorted[0]); });
    if (other != sorted.end())
        chosen.push_back(*other);
    const Posture turned = rotate_about_trunk(energy, sorted[0], std::numbers::pi * Vec3::UnitY());
    chosen.push_back(search_covered_limbs(energy, turned, k_wide_grid));
    const auto like_input = std::find_if(sorted.begin(), sorted.end(), [&](const Posture& s) {
        return (s.turn * energy.rig().front).dot(energy.rig().front) > std::cos(k_same_heading);
    });
    if (like_input != sorted.end() && like_input != sorted.begin() && like_input != other)
        chosen.push_back(*like_input);
    if (const auto promising = find_promising(energy, sorted))
        chosen.push_back(*promising);
    return chosen;
}

// Bones still pass through cloth, or a limb that should be covered is not.
bool has_failed(const FitEnergy& energy, const Posture& posture)
{
    if (energy.bones_through_cloth(posture) > 0)
        return true;
    const Skeleton joints = place_bones(energy.rest(), posture).joints;
    return std::any_of(k_limbs.begin(), k_limbs.end(), [&](const Limb& limb) {
        const int upper = limb.bones[0];
        return covers_first_bone(energy, limb)
            && (energy.metric().samples_inside(joints.head(upper), joints.tail(upper)) == 0
                || energy.misses_sleeve(upper, joints.tail(upper), joints));
    });
}

// The other starts that face as one does whose ascent failed.
Candidates replace_failed(const FitEnergy& energy, const Candidates& ascended, const std::vector<Posture>& sorted)
{
    Candidates failed, others;
    std::copy_if(ascended.begin(), ascended.end(), std::back_inserter(failed),
                 [&](const Candidate& one) { return has_failed(energy, one.posture); });
    for (std::size_t i = 1; i < sorted.size(); ++i)
        if (std::any_of(failed.begin(), failed.end(),
                        [&](const Candidate& one) { return !face_apart(energy.rig(), one.posture, sorted[i]); }))
            others.push_back({ sorted[i] });
    return others;
}

// ---------------------------------------------------------------- refinement

Posture better_of(const FitEnergy& energy, const Posture& present, const Posture& next)
{
    return energy.total(next) > energy.total(present) ? next : present;
}

// Limbs that are not covered as a whole are searched everywhere, covered ones about the mirror image of their twin.
Posture search_limbs_again(const FitEnergy& energy, Posture present)
{
    for (const Limb& limb : k_limbs) {
        if (!covers_both_bones(energy, limb))
            present = better_of(energy, present, search_limb(energy, present, limb, k_wide_grid));
        if (covers_first_bone(energy, limb))
            present = better_of(energy, present,
                                search_limb(energy, mirror_limb(energy.rig(), present, limb), limb, k_near_grid));
    }
    return present;
}

// A limb that still passes through cloth, such as a foot too long for its trouser leg, is searched more and more
// finely.
Posture free_limbs(const FitEnergy& energy, Posture present)
{
    for (const Limb& limb : k_limbs)
        for (LimbGrid grid = k_freeing_grid; grid.spacing > k_freeing_finest && energy.crossing_cost(present, limb) > 0;
             grid.spacing *= k_freeing_factor)
            present = better_of(energy, present, search_limb(energy, present, limb, grid));
    return present;
}

MinMaxPyramid pyramid_of(const ClearanceField& cloth) { return { cloth.tree(), cloth.low(), cloth.high() }; }

}  // namespace

Eigen::Quaterniond upright_turn(const Rig& rig, double heading)
{
    return Eigen::Quaterniond(Eigen::AngleAxisd(heading, Vec3::UnitY()))
        * shortest_arc(rig.up.normalized(), Vec3::UnitY());
}

std::vector<StartHypothesis> facing_hypotheses(const FitEnergy& energy)
{
    std::vector<StartHypothesis> hypotheses;
    for (const double heading : candidate_headings(energy))
        hypotheses.push_back({ upright_turn(energy.rig(), heading) });
    return hypotheses;
}

std::vector<Posture> find_rough_starts(const FitEnergy& energy, const std::vector<StartHypothesis>& hypotheses)
{
    const MinMaxPyramid clearance = pyramid_of(energy.metric().cloth());
    Candidates candidates = keep_distinct(find_places(energy, clearance, hypotheses), k_starts_searched);
    search_limbs_widely(energy, candidates);
    sort_best_first(candidates);
    return postures_of(candidates);
}

std::vector<Posture> ascend_starts(const FitEnergy& energy, const std::vector<Posture>& rough,
                                   const std::vector<Posture>& others)
{
    Candidates ascended;
    for (const auto& postures : { choose_for_ascent(energy, rough), others })
        for (const Posture& posture : postures)
            ascended.push_back({ posture });
    ascend_roughly(energy, ascended);
    Candidates more = replace_failed(energy, ascended, rough);
    ascend_roughly(energy, more);
    ascended.insert(ascended.end(), more.begin(), more.end());
    sort_best_first(ascended);
    return postures_of(ascended);
}

Posture refine_posture(const FitEnergy& energy, const Posture& start)
{
    return ascend(energy, free_limbs(energy, search_limbs_again(energy, start)), k_fine_steps);
}

}  // namespace garmentfit
