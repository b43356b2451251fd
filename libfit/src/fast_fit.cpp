// SPDX-License-Identifier: GPL-3.0-or-later
#include "fast_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <utility>

#include "fit/error.h"
#include "garment_type.h"
#include "outward_cloth.h"
#include "parallel.h"
#include "search_grids.h"
#include "skeleton_search.h"

namespace fit {
namespace {

constexpr int k_headings = 12;  // coarse turns about the vertical, 30 degrees apart
constexpr double k_coarse_step = 0.08;  // m; the thickness of an upper arm
constexpr int k_kept_places = 2;  // a heading
constexpr int k_kept_starts = 3;  // of all of them, for the fine search
constexpr double k_shortest_tip = 0.02;  // of an extremity; below, it ends at its joint
constexpr int k_partly_inside = 2, k_mostly_inside = 3;  // of a bone's five samples
constexpr double k_least_room = 0.2;  // of the room that covered bones need; tight clothes have 0.6 and more
constexpr Reach k_coarse_limbs { 1.8, 0.35, 3, false };
constexpr Reach k_wide_limbs { 2 * std::numbers::pi / 3, 0.26, 8, true };  // the paper's extent

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

// Roots from below a short shirt's hem up to its top.
std::vector<Vec3> coarse_roots(const ClothRoom& cloth, double trunk_length)
{
    const Vec3 low = cloth.low() - Vec3(0, 1.2 * trunk_length, 0), size = cloth.high() - low;
    const double step = std::max(k_coarse_step, std::cbrt(size.prod() / 4e3));
    const Eigen::Array3i steps = (size / step).array().floor().cast<int>();
    const Vec3 first = low + 0.5 * (size - step * steps.cast<double>().matrix());
    std::vector<Vec3> roots;
    for (int x = 0; x <= steps.x(); ++x)
        for (int y = 0; y <= steps.y(); ++y)
            for (int z = 0; z <= steps.z(); ++z)
                roots.push_back(first + step * Vec3(x, y, z));
    return roots;
}

double total(const SkeletonSearch& search, const Posture& posture)
{
    return search.energy(posture) - search.crossing_cost(posture);
}

bool is_worn(const SkeletonSearch& search, const Limb& limb) { return search.metric().figure().covered[limb.bones[0]]; }

Posture with_worn_limbs(const SkeletonSearch& search, Posture posture, const Reach& reach)
{
    for (const Limb& limb : k_limbs)
        if (is_worn(search, limb))
            posture = search.limb_moved(posture, limb, reach);
    return posture;
}

// The best places for one heading: the trunk alone bounds what limbs can add, so most places need no limbs.
std::vector<Scored> coarse_places(const SkeletonSearch& search, const Eigen::Quaterniond& turn,
                                  const std::vector<Vec3>& roots)
{
    Posture posture = search.at_ease(Vec3::Zero(), turn);
    std::vector<Scored> trunks;
    for (const Vec3& root : roots) {
        posture.root = root;
        trunks.push_back({ posture, search.trunk_energy(posture) });
    }
    std::stable_sort(trunks.begin(), trunks.end(), better);
    std::vector<Scored> places;
    for (const Scored& trunk : trunks) {
        if (places.size() == k_kept_places && trunk.score + search.largest_limb_energy() < places.back().score)
            break;
        const Posture with_limbs = with_worn_limbs(search, trunk.posture, k_coarse_limbs);
        places.push_back({ with_limbs, search.energy(with_limbs) });
        keep_best(places, k_kept_places);
    }
    return places;
}

// The best, no two of them alike: within a coarse step the fine search finds the same.
std::vector<Scored> distinct(std::vector<Scored> all, std::size_t count)
{
    std::stable_sort(all.begin(), all.end(), better);
    std::vector<Scored> kept;
    for (const Scored& one : all) {
        const bool is_new = std::none_of(kept.begin(), kept.end(), [&](const Scored& other) {
            return (one.posture.root - other.posture.root).norm() < k_coarse_step
                && one.posture.turn.angularDistance(other.posture.turn) < 0.1;
        });
        if (is_new && kept.size() < count)
            kept.push_back(one);
    }
    return kept;
}

// Half a coarse step to each side, limbs searched anew at each place, now without passing through cloth.
Scored settled(const SkeletonSearch& search, const Scored& start)
{
    std::vector<Scored> places;
    for (const Vec3& offset : grid_offsets(0.5 * k_coarse_step, 0.5 * k_coarse_step)) {
        Posture posture = start.posture;
        posture.root += offset;
        posture = with_worn_limbs(search, posture, k_coarse_limbs);
        places.push_back({ posture, search.energy(posture) });
    }
    keep_best(places, k_kept_places);
    for (Scored& place : places) {
        place.posture = with_worn_limbs(search, place.posture, k_wide_limbs);
        place.score = total(search, place.posture);
    }
    keep_best(places, 1);
    return places[0];
}

std::vector<Scored> starts(const Rig& rig, const SkeletonSearch& search, const Progress& progress)
{
    const Skeleton& own = rig.skeleton;
    const auto roots = coarse_roots(search.metric().cloth(), (own.tail(thorax) - own.root).norm());
    std::vector<std::vector<Scored>> places(k_headings);
    for (int begin = 0; begin < k_headings; begin += 4) {
        progress.at(double(begin) / k_headings);
        parallel_for(4, [&](int i) {
            const int h = begin + i;
            places[h] = coarse_places(search, heading(rig, 2 * std::numbers::pi * h / k_headings), roots);
        });
    }
    std::vector<Scored> all;
    for (auto& some : places)
        all.insert(all.end(), some.begin(), some.end());
    keep_best(all, 3 * k_kept_starts);
    for (Scored& place : all)
        place = settled(search, place);
    return distinct(all, k_kept_starts);
}

bool is_all_worn(const SkeletonSearch& search, const Limb& limb)
{
    const auto& covered = search.metric().figure().covered;
    return covered[limb.bones[0]] && covered[limb.bones[1]];
}

// Looks about each limb's present directions; in the first round also where its twin is, and anywhere for a bare one.
Posture limbs_moved(const SkeletonSearch& search, Posture present, int round)
{
    const double near = 0.6 * std::pow(0.5, round);
    for (const Limb& limb : k_limbs) {
        const double extent = round == 0 && !is_all_worn(search, limb) ? k_wide_limbs.extent : near;
        std::vector<Posture> tries { search.limb_moved(present, limb,
                                                       { extent, std::min(k_wide_limbs.spacing, extent / 4), 8 }) };
        if (round == 0 && is_worn(search, limb))
            tries.push_back(search.limb_moved(search.mirrored(present, limb), limb, { near, near / 4, 8 }));
        for (const Posture& moved : tries)
            if (total(search, moved) > total(search, present))
                present = moved;
    }
    return present;
}

// A limb that still passes through cloth, a foot too long for its trouser leg, is searched ever more finely.
Posture freed(const SkeletonSearch& search, Posture present)
{
    for (const Limb& limb : k_limbs)
        for (double spacing = 0.2; spacing > 0.06 && search.crossing_cost(present, limb) > 0; spacing *= 0.6)
            if (const Posture moved = search.limb_moved(present, limb, { 1.5, spacing, 40 });
                total(search, moved) > total(search, present))
                present = moved;
    return present;
}

// The paper's rounds: translation, rotation, bones; each halves extents and spacings.
Scored refined(const SkeletonSearch& search, Scored present, int iterations)
{
    for (int i = 0; i < iterations; ++i) {
        const double scale = std::pow(0.5, i);
        present.posture = search.translated(present.posture, { 0.06 * scale, 0.02 * scale });
        present.posture = search.rotated(present.posture, { 0.2 * scale, 0.1 * scale });
        present.posture = search.trunk_bent(present.posture, { 0.2 * scale, 0.1 * scale });
        present.posture = limbs_moved(search, present.posture, i);
        if (i == 0)
            present.posture = freed(search, present.posture);
    }
    present.score = total(search, present.posture);
    return present;
}

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

Posture best_posture(const Rig& rig, const SkeletonSearch& search, int iterations, const Progress& progress)
{
    std::vector<Scored> candidates = starts(rig, search, progress.part(0, 0.5));
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        progress.at(0.5 + 0.5 * double(i) / double(candidates.size()));
        candidates[i] = refined(search, candidates[i], iterations);
    }
    keep_best(candidates, 1);
    return candidates[0].posture;
}

// The paper's start: the root in the middle of the cloth.
Posture at_barycentre(const Rig& rig, const SkeletonSearch& search)
{
    const Vec3 middle = search.metric().cloth().points().colwise().mean();
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

FitResult fast_fit(const Rig& rig, const GarmentMesh& garment, GarmentType type, int iterations,
                   const Progress& progress)
{
    const TriangleMesh outward = outward_cloth(garment);
    if (is_sealed(outward))
        throw InvalidInput("garment is closed all round: nobody can get in; give a garment with openings");
    const ClothRoom cloth(outward, progress.part(0, 0.3, "look at the garment"));
    const std::vector<Opening> openings = openings_of(outward);
    const GarmentCues cues { front_of(openings), cuffs_of(openings) };
    const JointLimits limits(rig);

    const Figure nominal = figure_of(rig, bones_covered_by(type, openings));
    const BoneMetric nominal_metric(cloth, nominal);
    const SkeletonSearch first(rig, limits, nominal_metric, cues);
    Scored fitted { best_posture(rig, first, iterations, progress.part(0.3, 0.8, "fit the skeleton")) };
    require_fit(first, fitted.posture, sizes(rig, cloth));

    // Short sleeves were asked for a forearm: a bone that cannot be inside need not be.
    const Figure figure = figure_of(rig, bones_inside(first, fitted.posture, k_partly_inside));
    const BoneMetric metric(cloth, figure);
    const SkeletonSearch search(rig, limits, metric, cues);
    progress.part(0.8, 1, "fit the skeleton").at(0);
    fitted = refined(search, fitted, iterations);
    require_clear(search, fitted.posture);

    FitResult result;
    result.type = type;
    result.covered = bones_inside(search, fitted.posture, k_mostly_inside);
    result.pose = pose_of(rig.skeleton, fitted.posture);
    result.scores = scores(search, fitted.posture);
    result.scores_before = scores(search, at_barycentre(rig, search));
    return result;
}

}  // namespace fit
