// SPDX-License-Identifier: GPL-3.0-or-later
#include "fast_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include <Eigen/Eigenvalues>

#include "fit/error.h"
#include "garment_type.h"
#include "outward_cloth.h"
#include "parallel.h"
#include "search_grids.h"
#include "skeleton_search.h"

namespace fit {
namespace {

constexpr double k_place_spacing = 0.05;  // m
constexpr double k_places_apart = 0.08;  // m; the thickness of an upper arm
constexpr std::size_t k_places_a_heading = 4, k_wide_starts = 6, k_polished_starts = 2;
constexpr double k_clear_front = 0.5;  // m; a garment that much better one way round leaves no doubt
constexpr double k_same_heading = 0.25;  // rad
constexpr double k_shortest_tip = 0.02;  // of an extremity; below, it ends at its joint
constexpr int k_partly_inside = 2, k_mostly_inside = 3;  // of a bone's five samples
constexpr double k_least_room = 0.2;  // of the room that covered bones need; tight clothes have 0.6 and more
constexpr Reach k_coarse_limbs { 1.8, 0.35, 3, false };
constexpr Reach k_wide_limbs { 2 * std::numbers::pi / 3, 0.26, 8, true };  // the paper's extent
constexpr Reach k_near_limbs { 0.6, 0.15, 8, true };
constexpr double k_first_step = 0.16, k_last_step = 0.01;  // rad

struct Scored {
    Posture posture;
    double score = 0;
};

bool better(const Scored& a, const Scored& b) { return a.score > b.score; }

void keep_best(std::vector<Scored>& all, std::size_t count)
{
    std::stable_sort(all.begin(), all.end(), better);
    all.resize(std::min(all.size(), count));
}

// Stands the trunk upright and keeps its heading, then turns it about the vertical.
Eigen::Quaterniond heading(const Rig& rig, double angle)
{
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vec3::UnitY()))
        * shortest_arc(rig.up.normalized(), Vec3::UnitY());
}

// Necklines are lower in front, trousers rise higher behind, coats open in front, elbows bend forwards: openings face front.
Vec3 front_of(const std::vector<Opening>& openings)
{
    Vec3 sum = Vec3::Zero();
    for (const Opening& opening : openings)
        sum += opening.facing - opening.facing.y() * Vec3::UnitY();
    return sum;
}

bool is_worn(const SkeletonSearch& search, const Limb& limb) { return search.metric().figure().covered[limb.bones[0]]; }

Posture with_worn_limbs(const SkeletonSearch& search, Posture posture, const Reach& reach)
{
    for (const Limb& limb : k_limbs)
        if (is_worn(search, limb))
            posture = search.limb_moved(posture, limb, reach);
    return posture;
}

// The horizontal direction in which the cloth is spread most: from sleeve to sleeve, from leg to leg.
double widest_heading(const ClothRoom& cloth)
{
    Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
    for (const ClothPatch& patch : cloth.patches()) {
        const Vec3 from_middle = patch.centre.cast<double>() - cloth.barycentre();
        const Eigen::Vector2d level(from_middle.x(), from_middle.z());
        spread += level * level.transpose();
    }
    const Eigen::Vector2d widest = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(spread).eigenvectors().col(1);
    return std::atan2(-widest.y(), widest.x());
}

double turned_apart(double a, double b) { return std::abs(std::remainder(a - b, 2 * std::numbers::pi)); }

// Left to right along the cloth's widest direction or across it, either way round; and as the body stands.
std::vector<double> headings(const Rig& rig, const ClothRoom& cloth)
{
    const Vec3 left = rig.up.cross(rig.front);
    const double own = std::atan2(-left.z(), left.x()), widest = widest_heading(cloth) - own;
    std::vector<double> result { 0 };
    for (int quarter = 0; quarter < 4; ++quarter)
        if (turned_apart(widest + quarter * std::numbers::pi / 2, 0) > k_same_heading)
            result.push_back(widest + quarter * std::numbers::pi / 2);
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
    const ClothRoom& cloth = search.metric().cloth();
    const RoomPyramid room(cloth.tree(), cloth.low(), cloth.high());
    std::vector<Posture> postures;
    for (const double angle : headings(rig, cloth))
        postures.push_back(search.at_ease(Vec3::Zero(), heading(rig, angle)));
    std::vector<std::vector<Scored>> by_heading(postures.size());
    parallel_for<std::size_t>(postures.size(), [&](std::size_t h) {
        for (const Place& place :
             search.trunk_places(room, postures[h], k_place_spacing, k_places_apart, k_places_a_heading)) {
            postures[h].root = place.at;
            const Posture with_limbs = with_worn_limbs(search, postures[h], k_coarse_limbs);
            by_heading[h].push_back({ with_limbs, search.energy(with_limbs) });
        }
    });
    std::vector<Scored> all;
    for (auto& some : by_heading)
        all.insert(all.end(), some.begin(), some.end());
    return all;
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

Scored with_limbs_found(const SkeletonSearch& search, const Posture& start)
{
    const Posture posture = with_worn_limbs(search, start, k_wide_limbs);
    return { posture, search.total(posture) };
}

Scored roughly_polished(const SkeletonSearch& search, const Scored& start)
{
    const Posture posture = search.polished(start.posture, k_first_step, k_first_step / 4);
    return { posture, search.total(posture) };
}

Posture refined(const SkeletonSearch& search, const Posture& start)
{
    return search.polished(freed(search, limbs_reconsidered(search, start)), k_first_step / 2, k_last_step);
}

Vec3 front_in(const Rig& rig, const Scored& scored) { return scored.posture.turn * rig.front; }

// Equation (4): the bones that the garment covers, each by equation (1).
std::array<double, bone_count> scores(const SkeletonSearch& search, const Posture& posture)
{
    const Skeleton joints = placed(search.own(), posture).joints;
    std::array<double, bone_count> result {};
    for (int b = 0; b < bone_count; ++b)
        if (search.metric().figure().covered[b])
            result[b] = search.metric().worn(b, joints.head(b), joints.tail(b));
    return result;
}

// The evidence: of the bones that the type names, those that have at least so many of their five samples inside.
std::vector<Bone> bones_inside(const SkeletonSearch& search, const Posture& posture, int samples)
{
    const Skeleton joints = placed(search.own(), posture).joints;
    std::vector<Bone> inside;
    for (int b = 0; b < bone_count; ++b)
        if (search.metric().figure().covered[b]
            && search.metric().samples_inside(joints.head(b), joints.tail(b)) >= samples)
            inside.push_back(Bone(b));
    return inside;
}

std::string sizes(const Rig& rig, const ClothRoom& cloth)
{
    const Vec3 size = 100 * (cloth.high() - cloth.low());
    const Skeleton& own = rig.skeleton;
    char text[160];
    std::snprintf(text, sizeof text, "the garment is %.3g x %.3g x %.3g cm, the body's legs are %.3g cm long", size.x(),
                  size.y(), size.z(), 100 * (own.length(lfemur) + own.length(ltibia)));
    return text;
}

// What is inside must also have some room there: above a plate everything is half inside.
void require_fit(const SkeletonSearch& search, const Posture& posture, const std::string& sizes)
{
    const std::vector<Bone> inside = bones_inside(search, posture, k_mostly_inside);
    const Figure& figure = search.metric().figure();
    const auto by_bone = scores(search, posture);
    double needed = 0, found = 0;
    for (int b = 0; b < bone_count; ++b) {
        needed += figure.covered[b] ? 5 * figure.radii[b] : 0;
        found += std::max(0.0, by_bone[b]);
    }
    const auto covered = std::size_t(std::count(figure.covered.begin(), figure.covered.end(), true));
    if (2 * inside.size() < covered || found < k_least_room * needed)
        throw InvalidInput("no body fits into the garment: of the " + std::to_string(covered)
                           + " bones it should cover, " + std::to_string(inside.size()) + " can be put inside; " + sizes
                           + "; check the garment's units and type");
}

void require_clear(const SkeletonSearch& search, const Posture& posture)
{
    const Skeleton joints = placed(search.own(), posture).joints;
    const auto require = [&](const std::string& name, const Vec3& from, const Vec3& to) {
        if (!search.metric().cloth().crosses(from, to))
            return;
        char place[96];
        std::snprintf(place, sizeof place, "(%.2f, %.2f, %.2f) and (%.2f, %.2f, %.2f) m", from.x(), from.y(), from.z(),
                      to.x(), to.y(), to.z());
        throw SolverFailure("no pose found that keeps the bones clear of the cloth: " + name
                            + " passes through it between " + place
                            + "; check the garment's type, and that its openings are open");
    };
    for (int b = 0; b < bone_count; ++b)
        require(std::string(bone_name(b)), joints.head(b), joints.tail(b));
    require("the head", joints.tail(upperneck), joints.tips[head_top]);
}

struct Found {
    Posture posture;
    double front_margin;  // 0 (as good facing the other way) to 1
};

// The best start is also tried facing the other way round: most garments have as much room for that.
Found best_posture(const Rig& rig, const SkeletonSearch& search, const Progress& progress)
{
    std::vector<Scored> candidates = distinct(starts(rig, search), k_wide_starts);
    progress.at(0.4);
    parallel_for<std::size_t>(candidates.size(),
                              [&](std::size_t i) { candidates[i] = with_limbs_found(search, candidates[i].posture); });
    progress.at(0.6);
    keep_best(candidates, k_polished_starts);
    candidates.push_back(
        with_limbs_found(search, search.turned(candidates[0].posture, std::numbers::pi * Vec3::UnitY())));
    parallel_for<std::size_t>(candidates.size(),
                              [&](std::size_t i) { candidates[i] = roughly_polished(search, candidates[i]); });
    progress.at(0.8);
    keep_best(candidates, candidates.size());
    double margin = std::numeric_limits<double>::infinity();
    for (const Scored& other : candidates)
        if (front_in(rig, other).dot(front_in(rig, candidates[0])) < 0)
            margin = std::min(margin, candidates[0].score - other.score);
    return { candidates[0].posture, std::clamp(margin / k_clear_front, 0.0, 1.0) };
}

// The paper's start: the root in the middle of the cloth.
Posture at_barycentre(const Rig& rig, const SkeletonSearch& search)
{
    const Vec3 middle = search.metric().cloth().barycentre();
    return search.at_ease(middle, heading(rig, 0));
}

}  // namespace

Skeleton with_clear_tips(const Skeleton& joints, const GarmentMesh& garment)
{
    const TriangleTree cloth({ garment.positions, garment.triangles });
    Skeleton result = joints;
    for (int e = 0; e < extremity_count; ++e) {
        const Vec3& joint = joints.tail(bone_before(Extremity(e)));
        double reach = 1;
        while (reach > k_shortest_tip && cloth.is_met(joint, joint + reach * (joints.tips[e] - joint)))
            reach *= 0.8;
        if (reach < 1)  // once more, to keep some distance
            result.tips[e] = joint + (reach > k_shortest_tip ? 0.8 * reach : 0.0) * (joints.tips[e] - joint);
    }
    return result;
}

FitResult fast_fit(const Rig& rig, const GarmentMesh& garment, GarmentType given, const Progress& progress)
{
    const TriangleMesh outward = outward_cloth(garment);
    const std::vector<Opening> openings = openings_of(outward);
    const TypeGuess guess = resolved_type(given, openings);
    if (is_sealed(outward))
        throw InvalidInput("garment is closed all round: nobody can get in; give a garment with openings");
    const ClothRoom cloth(outward);
    const GarmentCues cues { front_of(openings), cuffs_of(openings) };
    const JointLimits limits(rig);

    const Figure nominal = figure_of(rig, bones_covered_by(guess.type, openings));
    const BoneMetric nominal_metric(cloth, nominal);
    const SkeletonSearch first(rig, limits, nominal_metric, cues);
    const Found found = best_posture(rig, first, progress.part(0.3, 0.8, "fit the skeleton"));
    require_fit(first, found.posture, sizes(rig, cloth));

    // Short sleeves were asked for a forearm: a bone that cannot be inside need not be.
    const Figure figure = figure_of(rig, bones_inside(first, found.posture, k_partly_inside));
    const BoneMetric metric(cloth, figure);
    const SkeletonSearch search(rig, limits, metric, cues);
    progress.part(0.8, 1, "fit the skeleton").at(0);
    const Posture fitted = refined(search, found.posture);
    require_clear(search, fitted);

    FitResult result;
    result.type = guess.type;
    result.type_margin = guess.margin;
    result.front_margin = found.front_margin;
    result.covered = bones_inside(search, fitted, k_mostly_inside);
    result.pose = pose_of(rig.skeleton, fitted);
    result.scores = scores(search, fitted);
    result.scores_before = scores(search, at_barycentre(rig, search));
    return result;
}

}  // namespace fit
