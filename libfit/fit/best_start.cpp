// SPDX-License-Identifier: GPL-3.0-or-later
#include "best_start.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>

#include <Eigen/Eigenvalues>

#include "climb.h"
#include "parallel.h"

namespace garmentfit {
namespace {

constexpr double k_place_spacing = 0.05;  // m
constexpr double k_places_apart = 0.08;  // m; the thickness of an upper arm
constexpr std::size_t k_places_a_heading = 4, k_wide_starts = 6;
constexpr double k_clear_front = 0.5;  // m; a garment that much better one way round leaves no doubt
constexpr double k_early_crossing = 0.1;  // of a crossing's cost
constexpr double k_same_heading = 0.25;  // rad
constexpr double k_promising = 0.3;  // m of energy; worth the work of freeing bones
constexpr Reach k_coarse_limbs { 1.8, 0.35, 3, false };
constexpr Reach k_wide_limbs { 2 * std::numbers::pi / 3, 0.26, 8, true };  // the paper's extent
constexpr Reach k_near_limbs { 0.6, 0.15, 8, true };
constexpr Steps k_rough { 0.16, 0.04 }, k_fine { 0.08, 0.01 };

struct Scored {
    Posture posture;
    double score = 0;
};

bool better(const Scored& a, const Scored& b) { return a.score > b.score; }

bool is_worn(const SkeletonSearch& search, const Limb& limb) { return search.metric().figure().covered[limb.bones[0]]; }

Posture with_worn_limbs(const SkeletonSearch& search, Posture posture, const Reach& reach)
{
    for (const Limb& limb : k_limbs)
        if (is_worn(search, limb))
            posture = search.limb_moved(posture, limb, reach);
    return posture;
}

// The horizontal direction in which the cloth is spread most.
Eigen::Vector2d widest(const ClearanceField& cloth)
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
double heading_across(const SkeletonSearch& search)
{
    const Vec3& across = search.cues().across;
    const Eigen::Vector2d level
        = across.isZero() ? widest(search.metric().cloth()) : Eigen::Vector2d(across.x(), across.z());
    return std::atan2(-level.y(), level.x());
}

double turned_apart(double a, double b) { return std::abs(std::remainder(a - b, 2 * std::numbers::pi)); }

// Left to right as the garment is, either way round; where no pair of sleeves or legs tells how that is, also across it, and as the body stands.
// What is nearly as the body stands is taken for that.
std::vector<double> headings(const Rig& rig, const SkeletonSearch& search)
{
    const Vec3 left = rig.up.cross(rig.front);
    const double own = std::atan2(-left.z(), left.x()), across = heading_across(search) - own;
    const bool is_told = !search.cues().across.isZero();
    std::vector<double> result;
    for (int quarter = 0; quarter < 4; quarter += is_told ? 2 : 1) {
        const double heading = across + quarter * std::numbers::pi / 2;
        result.push_back(turned_apart(heading, 0) > k_same_heading ? heading : 0);
    }
    if (!is_told && std::find(result.begin(), result.end(), 0.0) == result.end())
        result.push_back(0);
    std::stable_partition(result.begin(), result.end(), [](double heading) { return heading == 0; });
    return result;
}

// The best, no two of them alike: what is as near as that, the polish makes one.
std::vector<Scored> distinct(std::vector<Scored> all, std::size_t count)
{
    std::stable_sort(all.begin(), all.end(), better);
    std::vector<Scored> kept;
    for (const Scored& one : all) {
        const bool is_new = std::none_of(kept.begin(), kept.end(), [&](const Scored& other) {
            return (one.posture.root - other.posture.root).norm() < k_places_apart
                && one.posture.turn.angularDistance(other.posture.turn) < k_same_heading;
        });
        if (is_new && kept.size() < count)
            kept.push_back(one);
    }
    return kept;
}

// Where the trunk has room, for each heading, with limbs as far as a coarse look finds them.
std::vector<Scored> starts(const Rig& rig, const SkeletonSearch& search)
{
    const ClearanceField& cloth = search.metric().cloth();
    const MinMaxPyramid clearance(cloth.tree(), cloth.low(), cloth.high());
    std::vector<Posture> postures;
    for (const double angle : headings(rig, search))
        postures.push_back(search.at_ease(Vec3::Zero(), upright(rig, angle)));
    std::vector<std::vector<Place>> places(postures.size());
    parallel_for<std::size_t>(postures.size(), [&](std::size_t h) {
        places[h] = search.trunk_places(clearance, postures[h], k_place_spacing, k_places_apart, k_places_a_heading);
    });
    std::vector<Scored> all;
    for (std::size_t h = 0; h < postures.size(); ++h)
        for (const Place& place : places[h]) {
            all.push_back({ postures[h] });
            all.back().posture.root = place.at;
        }
    parallel_for<std::size_t>(all.size(), [&](std::size_t i) {
        all[i].posture = with_worn_limbs(search, all[i].posture, k_coarse_limbs);
        all[i].score = search.energy(all[i].posture);
    });
    return all;
}

// What still passes through cloth, the polish may free: before it, a crossing counts for less than a bone that is outside.
Scored with_limbs_found(const SkeletonSearch& search, const Posture& start)
{
    const Posture posture = with_worn_limbs(search, start, k_wide_limbs);
    return { posture, search.energy(posture) - k_early_crossing * search.crossing_cost(posture) };
}

// Hands and feet that stick in cloth are freed later.
Scored roughly_polished(const SkeletonSearch& search, const Scored& start)
{
    const Posture posture = polished(search, start.posture, k_rough);
    return { posture, search.total(posture) + (1 - k_early_crossing) * search.stuck_cost(posture) };
}

bool faces_away(const Rig& rig, const Scored& a, const Scored& b)
{
    return (a.posture.turn * rig.front).dot(b.posture.turn * rig.front) < 0;
}

bool is_all_worn(const SkeletonSearch& search, const Limb& limb)
{
    const auto& covered = search.metric().figure().covered;
    return covered[limb.bones[0]] && covered[limb.bones[1]];
}

Posture better_of(const SkeletonSearch& search, const Posture& present, const Posture& next)
{
    return search.total(next) > search.total(present) ? next : present;
}

// Looks anywhere for a bare limb, and for a worn one where its twin is.
Posture limbs_reconsidered(const SkeletonSearch& search, Posture present)
{
    for (const Limb& limb : k_limbs) {
        if (!is_all_worn(search, limb))
            present = better_of(search, present, search.limb_moved(present, limb, k_wide_limbs));
        if (is_worn(search, limb))
            present = better_of(search, present, search.limb_moved(search.mirrored(present, limb), limb, k_near_limbs));
    }
    return present;
}

// A limb that still passes through cloth, a foot too long for its trouser leg, is searched ever more finely.
Posture freed(const SkeletonSearch& search, Posture present)
{
    for (const Limb& limb : k_limbs)
        for (double spacing = 0.2; spacing > 0.06 && search.crossing_cost(present, limb) > 0; spacing *= 0.6)
            present = better_of(search, present, search.limb_moved(present, limb, { 1.5, spacing, 40 }));
    return present;
}

// The best but for what still passes through cloth, if that makes a clear difference.
std::optional<Scored> best_if_freed(const SkeletonSearch& search, const std::vector<Scored>& sorted)
{
    const auto most = std::max_element(sorted.begin(), sorted.end(), [&](const Scored& a, const Scored& b) {
        return search.energy(a.posture) < search.energy(b.posture);
    });
    const bool is_clear = search.energy(most->posture) > search.energy(sorted[0].posture) + k_promising;
    return is_clear ? std::optional<Scored>(*most) : std::nullopt;
}

// The best start, the best that faces the other way, and the best turned half round: most garments have as much room like that.
std::vector<Scored> both_ways_round(const Rig& rig, const SkeletonSearch& search, const std::vector<Scored>& sorted)
{
    std::vector<Scored> result { sorted[0] };
    const auto other
        = std::find_if(sorted.begin(), sorted.end(), [&](const Scored& s) { return faces_away(rig, s, sorted[0]); });
    if (other != sorted.end())
        result.push_back(*other);
    result.push_back(with_limbs_found(search, search.turned(sorted[0].posture, std::numbers::pi * Vec3::UnitY())));
    if (const auto freed = best_if_freed(search, sorted))
        result.push_back(*freed);
    return result;
}

void polish(const SkeletonSearch& search, std::vector<Scored>& candidates)
{
    parallel_for<std::size_t>(candidates.size(),
                              [&](std::size_t i) { candidates[i] = roughly_polished(search, candidates[i]); });
}

// Bones stay stuck in the cloth, or a limb that should be worn is not.
bool has_failed(const SkeletonSearch& search, const Posture& posture)
{
    if (search.bones_through_cloth(posture) > 0)
        return true;
    const Skeleton joints = place_bones(search.own(), posture).joints;
    return std::any_of(k_limbs.begin(), k_limbs.end(), [&](const Limb& limb) {
        const int upper = limb.bones[0];
        return is_worn(search, limb) && search.metric().samples_inside(joints.head(upper), joints.tail(upper)) == 0;
    });
}

// Of those that face as one does that the polish could not mend.
std::vector<Scored> others_instead(const Rig& rig, const SkeletonSearch& search, const std::vector<Scored>& polished,
                                   const std::vector<Scored>& sorted)
{
    std::vector<Scored> failed, result;
    std::copy_if(polished.begin(), polished.end(), std::back_inserter(failed),
                 [&](const Scored& one) { return has_failed(search, one.posture); });
    std::copy_if(sorted.begin() + 1, sorted.end(), std::back_inserter(result), [&](const Scored& start) {
        return std::any_of(failed.begin(), failed.end(), [&](const Scored& one) { return !faces_away(rig, one, start); });
    });
    return result;
}

}  // namespace

Eigen::Quaterniond upright(const Rig& rig, double heading)
{
    return Eigen::Quaterniond(Eigen::AngleAxisd(heading, Vec3::UnitY()))
        * shortest_arc(rig.up.normalized(), Vec3::UnitY());
}

BestStart best_start(const Rig& rig, const SkeletonSearch& search, const Progress& progress)
{
    std::vector<Scored> candidates = distinct(starts(rig, search), k_wide_starts);
    progress.at(0.4);
    parallel_for<std::size_t>(candidates.size(),
                              [&](std::size_t i) { candidates[i] = with_limbs_found(search, candidates[i].posture); });
    progress.at(0.6);
    std::stable_sort(candidates.begin(), candidates.end(), better);
    const std::vector<Scored> sorted = candidates;
    candidates = both_ways_round(rig, search, sorted);
    polish(search, candidates);
    std::vector<Scored> others = others_instead(rig, search, candidates, sorted);
    polish(search, others);
    candidates.insert(candidates.end(), others.begin(), others.end());
    progress.at(0.8);
    std::stable_sort(candidates.begin(), candidates.end(), better);
    const auto other = std::find_if(candidates.begin(), candidates.end(),
                                    [&](const Scored& s) { return faces_away(rig, s, candidates[0]); });
    const double margin = other == candidates.end() ? k_clear_front : candidates[0].score - other->score;
    return { candidates[0].posture, std::clamp(margin / k_clear_front, 0.0, 1.0) };
}

Posture refined(const SkeletonSearch& search, const Posture& start)
{
    return polished(search, freed(search, limbs_reconsidered(search, start)), k_fine);
}

}  // namespace garmentfit
