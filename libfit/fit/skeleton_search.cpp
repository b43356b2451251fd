// SPDX-License-Identifier: GPL-3.0-or-later
#include "skeleton_search.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "error_metric.h"
#include "search_grids.h"

namespace garmentfit {
namespace {

constexpr double k_crossing = 10;  // m; more than any room can repay
constexpr double k_stuck = 0.5;  // m; a foot stands across its trouser leg and may find no room there, nor may a hand
    // that is bent at the wrist find a way out of its cuff
constexpr double k_ease = 0.01;  // m/rad^2; worn bones stay near ease among near equals
constexpr double k_trunk_ease = 0.2;  // m/rad^2; the trunk bends less than limbs turn
constexpr double k_bare_trunk = 0.5;  // m/rad^2; above trousers the trunk is as it stands
constexpr double k_twins = 0.1;  // m/rad^2; limbs in sleeves and trouser legs are held alike
constexpr double k_own_pose = 0.05;  // m/rad^2; bare limbs stay near the body's own pose
constexpr double k_limit = 2;  // m/rad beyond a joint's range
constexpr double k_upright = 3;  // m/rad^2; the trunk stands
constexpr double k_sag = 1.5;  // m/m; a shirt hangs from the shoulders, trousers are pulled up
constexpr double k_cuff = 0.3;  // m/rad^2; arms point from the shoulder to the cuff
constexpr double k_front = 0.6;  // m; for each opening that faces forwards
constexpr double k_own_front = 0.05;  // m; where the garment does not tell its front, the body keeps its own
constexpr double k_empty = 8;  // m/m; mean distance of the cloth from the nearest limb that could fill it
constexpr double k_far_cloth = 0.25;  // m; cloth further away than this is just far: trains, wide skirts
constexpr double k_cover_cells = 8;  // along the garment's longest side
constexpr double k_between_legs = 0.25;  // of the distance between their hems
constexpr double k_better = 1e-9;  // m; below this two poses are equal, and the nearer one wins

constexpr std::array<int, 7> k_trunk { lhipjoint, rhipjoint, lowerback, upperback, thorax, lclavicle, rclavicle };

// What is looked for a place for before limbs are searched; legs stand as they hang, arms may point anywhere.
constexpr std::array<int, 9> k_placed { lhipjoint, rhipjoint, lowerback, upperback, thorax,
                                        lclavicle, rclavicle, lfemur,    rfemur };

bool is_trunk(int bone) { return std::find(k_trunk.begin(), k_trunk.end(), bone) != k_trunk.end(); }

bool is_foot(Extremity extremity) { return extremity == lfoot_tip || extremity == rfoot_tip; }

// Ankles and wrists do not bend: what lies beyond is as the body held it.
bool may_stick(Extremity extremity) { return extremity != head_top; }

Vec3 reflected(const Vec3& direction, const Vec3& axis) { return direction - 2 * direction.dot(axis) * axis; }

// One point, the mean, for each cell that has cloth.
Eigen::ArrayX3f spread_points(const ClearanceField& cloth, double cells)
{
    const double cell = (cloth.high() - cloth.low()).maxCoeff() / cells;
    std::map<std::tuple<int, int, int>, std::pair<Vec3, int>> sums;
    for (const ClothPatch& patch : cloth.patches()) {
        const Vec3 p = patch.centre.cast<double>();
        const Eigen::Vector3i c = ((p - cloth.low()) / cell).array().floor().cast<int>();
        auto& [sum, count] = sums.try_emplace({ c.x(), c.y(), c.z() }, Vec3(Vec3::Zero()), 0).first->second;
        sum += p;
        ++count;
    }
    Eigen::ArrayX3f points(sums.size(), 3);
    Eigen::Index row = 0;
    for (const auto& [key, value] : sums)
        points.row(row++) = (value.first / value.second).cast<float>().transpose();
    return points;
}

}  // namespace

/// The bones of a limb so far.
struct SkeletonSearch::Chain {
    Vec3 tail;
    Eigen::Quaterniond turn;
    std::array<Vec3, 2> directions;
    double score = 0;
    CoverDistances distances;
};

SkeletonSearch::SkeletonSearch(const Rig& rig, const JointLimits& limits, const BoneMetric& metric,
                               const GarmentCues& cues) :
    rig_(rig),
    limits_(limits), metric_(metric), cover_(spread_points(metric.cloth(), k_cover_cells)), cues_(cues),
    hangs_from_shoulders_(metric.figure().covered[lclavicle])
{
}

// Bones that are worn, in this garment or in another, and the trunk would be at ease, bare limbs as they were given; nobody leaves the range of a joint.
double SkeletonSearch::posture_cost(int bone, const Vec3& direction, const Eigen::Quaterniond& parent_turn) const
{
    const bool in_trunk = is_trunk(bone);
    const bool worn = metric_.figure().covered[bone] || metric_.figure().worn_elsewhere[bone];
    const Vec3 wish
        = worn || in_trunk ? limits_.comfort_direction(bone, parent_turn)
                           : parent_turn * rig_.skeleton.direction(bone);
    const double ease = in_trunk ? (worn ? k_trunk_ease : k_bare_trunk) : worn ? k_ease : k_own_pose;
    const double angle = angle_between(direction, wish);
    return ease * angle * angle + k_limit * limits_.excess(bone, parent_turn, direction);
}

double SkeletonSearch::twin_cost(int bone, const Vec3& direction, const Skeleton& joints) const
{
    const int twin = mirror_of(bone);
    if (twin == bone || is_trunk(bone) || !metric_.figure().covered[bone] || !metric_.figure().covered[twin])
        return 0;
    const Vec3 left = (joints.tail(lhipjoint) - joints.tail(rhipjoint)).normalized();
    const double angle = angle_between(direction, reflected(joints.direction(twin), left));
    return k_twins * angle * angle;
}

// An arm may find room elsewhere, in a wide shirt's body say, but what a sleeve is for is plain.
double SkeletonSearch::cuff_cost(int bone, const Vec3& tail, const Skeleton& joints) const
{
    const bool is_left = bone == lhumerus || bone == lradius;
    const bool is_right = bone == rhumerus || bone == rradius;
    if (cues_.cuffs.empty() || !metric_.figure().covered[bone] || is_left == is_right)
        return 0;
    const Vec3 left = joints.tail(lhipjoint) - joints.tail(rhipjoint);
    const bool first_is_left = left.dot(cues_.cuffs[0] - cues_.cuffs[1]) > 0;
    const Vec3& cuff = cues_.cuffs[is_left == first_is_left ? 0 : 1];
    const Vec3& shoulder = joints.tail(is_left ? lclavicle : rclavicle);
    const double angle = angle_between((tail - shoulder).normalized(), (cuff - shoulder).normalized());
    return k_cuff * angle * angle;
}

// k_any where it cannot come above `least`, however much room there is: angles are sooner asked than cloth.
double SkeletonSearch::bone_energy(int bone, const Vec3& head, const Vec3& tail, const Eigen::Quaterniond& parent_turn,
                                   const Skeleton& joints, double least) const
{
    const Vec3 direction = (tail - head).normalized();
    const double posture = posture_cost(bone, direction, parent_turn), twin = twin_cost(bone, direction, joints),
                 cuff = cuff_cost(bone, tail, joints);
    if (metric_.most(bone) - posture - twin - cuff <= least)
        return k_any;
    return metric_.value(bone, head, tail) - metric_.overlap(bone, head, tail, joints) - posture - twin - cuff;
}

double SkeletonSearch::sag() const { return hangs_from_shoulders_ ? k_sag : -k_sag; }

double SkeletonSearch::stance_energy(const Posture& posture) const
{
    const Vec3 front = posture.turn * rig_.front;
    const double tilt = angle_between(posture.turn * rig_.up.normalized(), Vec3::UnitY());
    const double facing = k_front * front.dot(cues_.front) + k_own_front * front.dot(rig_.front);
    return sag() * posture.root.y() - k_upright * tilt * tilt + facing;
}

CoverDistances SkeletonSearch::cover_distances(int bone, const Vec3& head, const Vec3& tail) const
{
    const auto& points = cover_;
    const Eigen::Array3f a = head.cast<float>(), ab = (tail - head).cast<float>();
    const float inverse = 1 / ab.square().sum();
    const Eigen::ArrayXf x = points.col(0) - a.x(), y = points.col(1) - a.y(), z = points.col(2) - a.z();
    const Eigen::ArrayXf t = ((x * ab.x() + y * ab.y() + z * ab.z()) * inverse).max(0.f).min(1.f);
    const float radius = float(metric_.figure().radii[bone]);
    return (((x - t * ab.x()).square() + (y - t * ab.y()).square() + (z - t * ab.z()).square()).sqrt() - radius)
        .max(0.f);
}

CoverDistances SkeletonSearch::cover_distances(const PlacedBones& bones, const Limb& without) const
{
    CoverDistances distances = CoverDistances::Constant(cover_.rows(), k_far_cloth);
    for (int b = 0; b < bone_count; ++b)
        if (metric_.figure().covered[b] && b != without.bones[0] && b != without.bones[1])
            distances = distances.min(cover_distances(b, bones.joints.head(b), bones.joints.tail(b)));
    return distances;
}

double SkeletonSearch::emptiness(const CoverDistances& distances) const { return k_empty * double(distances.mean()); }

double SkeletonSearch::tip_energy(const PlacedBones& bones, int extremity) const
{
    return metric_.bare_tip(Extremity(extremity), bones.joints.tail(bone_before(Extremity(extremity))),
                            bones.joints.tips[extremity]);
}

// lower(distances, b) takes a worn bone's distances into account.
template <class BoneEnergy, class TipEnergy, class Lower>
double SkeletonSearch::sum_of(const Posture& posture, const BoneEnergy& by_bone, const TipEnergy& by_tip,
                              const Lower& lower) const
{
    CoverDistances distances = CoverDistances::Constant(cover_.rows(), k_far_cloth);
    for (int b = 0; b < bone_count; ++b)
        if (metric_.figure().covered[b])
            lower(distances, b);
    double sum = stance_energy(posture) - emptiness(distances);
    for (int b = 0; b < bone_count; ++b)
        sum += by_bone(b);
    for (int e = 0; e < extremity_count; ++e)
        sum += by_tip(e);
    return sum;
}

EnergyParts SkeletonSearch::parts(const Posture& posture) const
{
    EnergyParts parts { place_bones(rig_.skeleton, posture), {}, {}, {}, 0 };
    const Skeleton& joints = parts.bones.joints;
    for (int b = 0; b < bone_count; ++b) {
        parts.by_bone[b] = bone_energy(b, joints.head(b), joints.tail(b), parts.bones.parent_turn(b), joints);
        if (metric_.figure().covered[b])
            parts.cover[b] = cover_distances(b, joints.head(b), joints.tail(b));
    }
    for (int e = 0; e < extremity_count; ++e)
        parts.by_tip[e] = tip_energy(parts.bones, e);
    parts.energy = sum_of(
        posture, [&](int b) { return parts.by_bone[b]; }, [&](int e) { return parts.by_tip[e]; },
        [&](CoverDistances& distances, int b) { distances = distances.min(parts.cover[b]); });
    return parts;
}

double SkeletonSearch::energy(const Posture& posture, const EnergyParts& near) const
{
    const PlacedBones bones = place_bones(rig_.skeleton, posture, near.bones);
    const Skeleton &joints = bones.joints, &before = near.bones.joints;
    std::array<bool, bone_count> moved, turned;
    for (int b = 0; b < bone_count; ++b) {
        moved[b] = joints.head(b) != before.head(b) || joints.tail(b) != before.tail(b);
        turned[b] = moved[b] || bones.parent_turn(b).coeffs() != near.bones.parent_turn(b).coeffs();
    }
    const bool hips = moved[lhipjoint] || moved[rhipjoint],
               spine = moved[lowerback] || moved[upperback] || moved[thorax];
    return sum_of(
        posture,
        [&](int b) {  // twins are held alike on either side of the hips; arms keep out of the trunk and point from the shoulder to the cuff
            const bool is_left = b == lhumerus || b == lradius;
            const bool looks_at_moved
                = moved[mirror_of(b)] || hips || (is_arm(b) && (spine || moved[is_left ? lclavicle : rclavicle]));
            return turned[b] || looks_at_moved
                ? bone_energy(b, joints.head(b), joints.tail(b), bones.parent_turn(b), joints)
                : near.by_bone[b];
        },
        [&](int e) {
            const int b = bone_before(Extremity(e));
            return joints.tail(b) != before.tail(b) || joints.tips[e] != before.tips[e] ? tip_energy(bones, e)
                                                                                        : near.by_tip[e];
        },
        [&](CoverDistances& distances, int b) {
            if (moved[b])
                distances = distances.min(cover_distances(b, joints.head(b), joints.tail(b)));
            else
                distances = distances.min(near.cover[b]);
        });
}

double SkeletonSearch::crossing_cost(const PlacedBones& bones, Extremity extremity) const
{
    const bool crosses
        = metric_.cloth().crosses(bones.joints.tail(bone_before(extremity)), bones.joints.tips[extremity]);
    return crosses ? (may_stick(extremity) ? k_stuck : k_crossing) : 0;
}

int SkeletonSearch::bones_through_cloth(const Posture& posture) const
{
    const Skeleton joints = place_bones(rig_.skeleton, posture).joints;
    int count = 0;
    for (int b = 0; b < bone_count; ++b)
        count += metric_.cloth().crosses(joints.head(b), joints.tail(b));
    return count;
}

std::array<double, bone_count> SkeletonSearch::scores(const Posture& posture) const
{
    const Skeleton joints = place_bones(rig_.skeleton, posture).joints;
    std::array<double, bone_count> result {};
    for (int b = 0; b < bone_count; ++b)
        if (metric_.figure().covered[b])
            result[b] = metric_.worn(b, joints.head(b), joints.tail(b));
    return result;
}

double SkeletonSearch::crossing_cost(const Posture& posture) const
{
    const PlacedBones bones = place_bones(rig_.skeleton, posture);
    double cost = k_crossing * bones_through_cloth(posture);
    for (int e = 0; e < extremity_count; ++e)
        cost += crossing_cost(bones, Extremity(e));
    return cost;
}

double SkeletonSearch::stuck_cost(const Posture& posture) const
{
    const PlacedBones bones = place_bones(rig_.skeleton, posture);
    double cost = 0;
    for (int e = 0; e < extremity_count; ++e)
        cost += may_stick(Extremity(e)) ? crossing_cost(bones, Extremity(e)) : 0;
    return cost;
}

double SkeletonSearch::crossing_cost(const Posture& posture, const Limb& limb) const
{
    const PlacedBones bones = place_bones(rig_.skeleton, posture);
    double cost = crossing_cost(bones, limb.end);
    for (const int b : limb.bones)
        cost += metric_.cloth().crosses(bones.joints.head(b), bones.joints.tail(b)) ? k_crossing : 0;
    return cost;
}

Posture SkeletonSearch::at_ease(const Vec3& root, const Eigen::Quaterniond& turn) const
{
    Posture posture { root, turn, {} };
    std::array<Eigen::Quaterniond, bone_count> turns;
    for (int b = 0; b < bone_count; ++b) {
        const Eigen::Quaterniond parent_turn = parent_of(b) < 0 ? turn : turns[parent_of(b)];
        posture.directions[b] = limits_.comfort_direction(b, parent_turn);
        turns[b] = bone_turn(rig_.skeleton, b, parent_turn, posture.directions[b]);
    }
    return posture;
}

std::vector<Place> SkeletonSearch::trunk_places(const MinMaxPyramid& clearance, const Posture& posture, double spacing,
                                                double apart, std::size_t count) const
{
    Posture at_origin = posture;
    at_origin.root = Vec3::Zero();
    const Skeleton joints = place_bones(rig_.skeleton, at_origin).joints;
    std::vector<RoomSample> samples;
    for (const int b : k_placed)
        for (int i = 0; i < k_samples && metric_.figure().covered[b]; i += 2)  // both ends and the middle tell enough
            samples.push_back({ bone_sample(joints.head(b), joints.tail(b), i), metric_.figure().radii[b] });
    const ClearanceField& cloth = metric_.cloth();
    const double hem
        = hangs_from_shoulders_ ? (joints.tail(thorax) - joints.root).norm() : 0;  // its root may lie below
    return ClearanceSearch(clearance, samples, sag() * Vec3::UnitY(), between_legs())
        .best(cloth.low() - 1.2 * hem * Vec3::UnitY(), cloth.high(), spacing, apart, count);
}

// A slim body may find room for all of it in one of a wide garment's legs.
Slab SkeletonSearch::between_legs() const
{
    if (cues_.hems.empty())
        return {};
    const Vec3 apart = cues_.hems[1] - cues_.hems[0];
    return { 0.5 * (cues_.hems[0] + cues_.hems[1]), apart.stableNormalized(), k_between_legs * apart.norm() };
}

// About the middle of the trunk: a turn about the root would swing the shoulders out of the garment.
Posture SkeletonSearch::turned(const Posture& present, const Vec3& rotation_vector) const
{
    const Skeleton joints = place_bones(rig_.skeleton, present).joints;
    const Vec3 centre = hangs_from_shoulders_ ? joints.tail(thorax) : joints.root;
    const Eigen::Quaterniond turn = turned_by(rotation_vector);
    Posture moved = present;
    moved.root = centre + turn * (present.root - centre);
    moved.turn = (turn * present.turn).normalized();
    for (Vec3& direction : moved.directions)
        direction = turn * direction;
    return moved;
}

// A limb fills a tube of its own where the garment covers its lower bone, or is a sleeve; legs in a skirt share theirs.
bool SkeletonSearch::fills_tube(const Limb& limb) const
{
    return metric_.figure().covered[limb.bones[is_foot(limb.end) ? 1 : 0]];
}

std::vector<SkeletonSearch::Chain> SkeletonSearch::extended(const Chain& chain, const Limb& limb, int link,
                                                            const Vec3& start, const Skeleton& joints,
                                                            const Reach& reach, double least) const
{
    const Vec3 clavicle = joints.direction(parent_of(limb.bones[0]));
    const int bone = limb.bones[link];
    const bool explains = chain.distances.size() > 0;
    const bool worn = metric_.figure().covered[bone];
    const bool forearm = bone == lradius || bone == rradius, is_last = link == 1;
    const double empty
        = explains && worn ? emptiness(chain.distances) : 0;  // at most that much is gained by filling it
    std::vector<Chain> result;
    for (const Vec3& direction : directions_about(start, reach.extent, reach.spacing)) {
        if (worn
            && (limits_.excess(bone, chain.turn, direction) > 0 || (forearm && folds_into_chest(clavicle, direction))))
            continue;
        const Vec3 tail = chain.tail + rig_.skeleton.length(bone) * direction;
        const double energy
            = bone_energy(bone, chain.tail, tail, chain.turn, joints, least - chain.score - empty - k_better);
        if (energy == k_any)
            continue;
        Chain next = chain;
        next.directions[link] = direction;
        next.tail = tail;
        next.score += energy;
        if (explains && worn) {
            next.distances = next.distances.min(cover_distances(bone, chain.tail, next.tail));
            next.score += empty - emptiness(next.distances);
        }
        next.turn = bone_turn(rig_.skeleton, bone, chain.turn, direction);
        if (is_last)
            next.score += tip_energy(limb, next);
        if (is_last && !reach.exact)  // nothing else speaks against the best
            least = std::max(least, next.score);
        result.push_back(std::move(next));
    }
    return result;
}

// Arms and legs come in pairs, and so do sleeves: what one of them found may suit the other.
Posture SkeletonSearch::mirrored(const Posture& present, const Limb& limb) const
{
    const Vec3 left = present.turn * rig_.up.cross(rig_.front).normalized();
    Posture moved = present;
    for (const int b : limb.bones)
        moved.directions[b] = reflected(present.directions[mirror_of(b)], left);
    return moved;
}

Vec3 SkeletonSearch::tip_of(const Limb& limb, const Chain& chain) const
{
    return chain.tail + chain.turn * (rig_.skeleton.tips[limb.end] - rig_.skeleton.tail(limb.bones[1]));
}

double SkeletonSearch::tip_energy(const Limb& limb, const Chain& chain) const
{
    return metric_.bare_tip(limb.end, chain.tail, tip_of(limb, chain));
}

Posture SkeletonSearch::limb_moved(const Posture& present, const Limb& limb, const Reach& reach) const
{
    const PlacedBones bones = place_bones(rig_.skeleton, present);
    const auto [upper, lower] = limb.bones;
    const auto better = [](const Chain& a, const Chain& b) { return a.score > b.score; };
    const auto crosses
        = [&](const Vec3& from, const Vec3& to) { return reach.exact && metric_.cloth().crosses(from, to); };

    Chain root { bones.joints.head(upper), bones.parent_turn(upper), { Vec3::Zero(), Vec3::Zero() }, 0, {} };
    if (reach.exact && fills_tube(limb))
        root.distances = cover_distances(bones, limb);
    std::vector<Chain> uppers = extended(root, limb, 0, present.directions[upper], bones.joints, reach, k_any);
    std::stable_sort(uppers.begin(), uppers.end(), better);

    Chain best;
    bool found = false;
    std::vector<Vec3> kept;
    for (const Chain& first : uppers) {
        const Vec3& direction = first.directions[0];
        const bool alike = std::any_of(
            kept.begin(), kept.end(), [&](const Vec3& k) { return angle_between(k, direction) < 1.5 * reach.spacing; });
        if (alike || crosses(root.tail, first.tail))
            continue;
        if (int(kept.size()) == reach.beam)
            break;
        kept.push_back(direction);
        const Vec3 start = shortest_arc(present.directions[upper], direction) * present.directions[lower];
        std::vector<Chain> lowers = extended(first, limb, 1, start, bones.joints, reach, found ? best.score : k_any);
        std::stable_sort(lowers.begin(), lowers.end(), better);
        for (const Chain& second : lowers) {
            if (found && second.score <= best.score + k_better)
                break;
            if (crosses(first.tail, second.tail))
                continue;
            const bool stuck = crosses(second.tail, tip_of(limb, second));
            if (stuck && !may_stick(limb.end))
                continue;
            const double score = second.score - (stuck ? k_stuck : 0);
            if (found && score <= best.score + k_better)
                continue;
            best = second;
            best.score = score;
            found = true;
            if (!stuck)
                break;
        }
    }
    if (!found)
        return present;
    Posture moved = present;
    moved.directions[upper] = best.directions[0];
    moved.directions[lower] = best.directions[1];
    return moved;
}

}  // namespace garmentfit
