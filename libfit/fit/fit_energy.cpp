// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit_energy.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "search_grids.h"
#include "segment.h"

namespace garmentfit {
namespace {

// One point for each cell that has cloth: the mean of its patches.
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

// What differs between two placed skeletons, bone by bone.
class Changes {
public:
    Changes(const PlacedBones& before, const PlacedBones& after) : before_(before), after_(after)
    {
        for (int b = 0; b < bone_count; ++b) {
            moved_[b] = after.joints.head(b) != before.joints.head(b) || after.joints.tail(b) != before.joints.tail(b);
            turned_[b] = moved_[b] || after.parent_turn(b).coeffs() != before.parent_turn(b).coeffs();
        }
        hips_ = moved_[lhipjoint] || moved_[rhipjoint];
        spine_ = moved_[lowerback] || moved_[upperback] || moved_[thorax];
    }

    bool has_moved(int bone) const { return moved_[bone]; }

    // Twins are compared across the hips. Arms keep out of the trunk, and point from the shoulder to the cuff.
    bool affects_bone(int b) const
    {
        const int clavicle = is_left_arm(b) ? lclavicle : rclavicle;
        return turned_[b] || moved_[mirror_of(b)] || hips_ || (is_arm(b) && (spine_ || moved_[clavicle]));
    }

    bool affects_tip(int e) const
    {
        const int b = bone_before(Extremity(e));
        return after_.joints.tail(b) != before_.joints.tail(b) || after_.joints.tips[e] != before_.joints.tips[e];
    }

private:
    const PlacedBones &before_, &after_;
    std::array<bool, bone_count> moved_, turned_;
    bool hips_, spine_;
};

}  // namespace

FitEnergy::FitEnergy(const Rig& rig, const JointLimits& limits, const BoneMetric& metric, const GarmentCues& cues,
                     double bone_thickness) :
    rig_(rig),
    limits_(limits), metric_(metric), weights_(metric.weights()),
    coverage_points_(spread_points(metric.cloth(), k_coverage_cells)), cues_(cues),
    hangs_from_shoulders_(metric.covers(lclavicle)), bone_thickness_(bone_thickness)
{
    const Skeleton& rest = rig.skeleton;
    const double trunk = rest.length(lowerback) + rest.length(upperback) + rest.length(thorax);
    lowest_root_ = metric.cloth().low().y() - (hangs_from_shoulders_ ? k_hem_reach * trunk : 0);
    highest_root_ = metric.cloth().high().y();
}

// Covered bones and the trunk prefer comfort, uncovered limbs the input pose. All keep within the range of their
// joints.
double FitEnergy::posture_cost(int bone, const Vec3& direction, const Eigen::Quaterniond& parent_turn) const
{
    const bool in_trunk = is_trunk(bone);
    const bool covered = metric_.covers(bone) || metric_.limbs().covered_elsewhere[bone];
    const Vec3 preferred = covered || in_trunk ? limits_.comfort_direction(bone, parent_turn)
                                               : parent_turn * rig_.skeleton.direction(bone);
    const double weight = in_trunk ? (covered ? weights_.comfort_trunk : weights_.comfort_uncovered_trunk)
        : covered                  ? weights_.comfort
                                   : weights_.input_pose;
    const double angle = angle_between(direction, preferred);
    return weight * angle * angle + weights_.joint_limit * limits_.excess(bone, parent_turn, direction);
}

double FitEnergy::symmetry_cost(int bone, const Vec3& direction, const Skeleton& joints) const
{
    const int twin = mirror_of(bone);
    if (twin == bone || is_trunk(bone) || !metric_.covers(bone) || !metric_.covers(twin))
        return 0;
    const Vec3 left = (joints.tail(lhipjoint) - joints.tail(rhipjoint)).normalized();
    const double angle = angle_between(direction, reflect(joints.direction(twin), left));
    return weights_.symmetry * angle * angle;
}

// A wide shirt's body may offer an arm more clearance than its sleeve: the cuffs tell where arms belong.
double FitEnergy::cuff_cost(int bone, const Vec3& tail, const Skeleton& joints) const
{
    const bool is_left = is_left_arm(bone);
    if (cues_.cuffs.empty() || !metric_.covers(bone) || is_left == is_right_arm(bone))
        return 0;
    const Vec3 left = joints.tail(lhipjoint) - joints.tail(rhipjoint);
    const bool first_is_left = left.dot(cues_.cuffs[0] - cues_.cuffs[1]) > 0;
    const Vec3& cuff = cues_.cuffs[is_left == first_is_left ? 0 : 1];
    const Vec3& shoulder = joints.tail(is_left ? lclavicle : rclavicle);
    const double angle = angle_between((tail - shoulder).normalized(), (cuff - shoulder).normalized());
    return weights_.cuff_direction * angle * angle;
}

// Without sleeves there is as much clearance beside the middle as in it, and one strap lies on an upper arm. Both
// shoulders count for the left one.
double FitEnergy::armhole_cost(int bone, const Vec3& tail, const Skeleton& joints) const
{
    if (cues_.armholes.empty() || bone != lclavicle)
        return 0;
    const Vec3 across = (cues_.armholes[1] - cues_.armholes[0]).normalized(),
               between = 0.5 * (cues_.armholes[0] + cues_.armholes[1]), middle = 0.5 * (tail + joints.tail(rclavicle));
    const double beside = (middle - between).dot(across);
    return weights_.armhole * beside * beside;
}

double FitEnergy::bone_value(int bone, const Vec3& head, const Vec3& tail, const Eigen::Quaterniond& parent_turn,
                             const Skeleton& joints, double least) const
{
    const Vec3 direction = (tail - head).normalized();
    const double posture = posture_cost(bone, direction, parent_turn),
                 symmetry = symmetry_cost(bone, direction, joints),
                 opening = cuff_cost(bone, tail, joints) + armhole_cost(bone, tail, joints);
    if (metric_.max_value(bone) - posture - symmetry - opening <= least)
        return k_any;
    return metric_.value(bone, head, tail) - metric_.trunk_overlap(bone, head, tail, joints) - posture - symmetry
        - opening;
}

double FitEnergy::tip_value(int extremity, const PlacedBones& bones) const
{
    return metric_.uncovered_tip_value(Extremity(extremity), bones.joints.tail(bone_before(Extremity(extremity))),
                                       bones.joints.tips[extremity]);
}

// The cloth may turn the body a little, but not away from where the user says that it faces.
double FitEnergy::facing_cost(const Posture& posture) const
{
    if (!cues_.front_given)
        return 0;
    const double excess = angle_between(posture.turn * rig_.front, *cues_.front_given) - k_facing_play;
    return excess > 0 ? weights_.facing * excess * excess : 0;
}

double FitEnergy::stance_value(const Posture& posture) const
{
    const double tilt = angle_between(posture.turn * rig_.up.normalized(), Vec3::UnitY());
    return hang_slope() * std::clamp(posture.root.y(), lowest_root_, highest_root_) - weights_.upright * tilt * tilt
        - facing_cost(posture);
}

CoverageDistances FitEnergy::coverage_distances(int bone, const Vec3& head, const Vec3& tail) const
{
    const auto& points = coverage_points_;
    const Eigen::Array3f a = head.cast<float>(), ab = (tail - head).cast<float>();
    const float inverse = 1 / ab.square().sum();
    const Eigen::ArrayXf x = points.col(0) - a.x(), y = points.col(1) - a.y(), z = points.col(2) - a.z();
    const Eigen::ArrayXf t = ((x * ab.x() + y * ab.y() + z * ab.z()) * inverse).max(0.f).min(1.f);
    const float radius = float(metric_.limbs().radii[bone]);
    return (((x - t * ab.x()).square() + (y - t * ab.y()).square() + (z - t * ab.z()).square()).sqrt() - radius)
        .max(0.f);
}

CoverageDistances FitEnergy::coverage_distances(const PlacedBones& bones, const Limb& without) const
{
    CoverageDistances distances = CoverageDistances::Constant(coverage_points_.rows(), float(weights_.coverage_cutoff));
    for (int b = 0; b < bone_count; ++b)
        if (metric_.covers(b) && b != without.bones[0] && b != without.bones[1])
            distances = distances.min(coverage_distances(b, bones.joints.head(b), bones.joints.tail(b)));
    return distances;
}

double FitEnergy::mean_coverage_distance(const Posture& posture) const
{
    constexpr Limb none { { bone_count, bone_count }, head_top };
    return double(coverage_distances(place_bones(rig_.skeleton, posture), none).mean());
}

// lower(distances, b) takes the minimum with a covered bone's distances. The order of the sum is fixed: it decides the
// last bits.
template <class BoneValue, class TipValue, class Lower>
double FitEnergy::sum_terms(const Posture& posture, const BoneValue& by_bone, const TipValue& by_tip,
                            const Lower& lower) const
{
    CoverageDistances distances = CoverageDistances::Constant(coverage_points_.rows(), float(weights_.coverage_cutoff));
    for (int b = 0; b < bone_count; ++b)
        if (metric_.covers(b))
            lower(distances, b);
    double sum = stance_value(posture) - coverage_cost(distances);
    for (int b = 0; b < bone_count; ++b)
        sum += by_bone(b);
    for (int e = 0; e < extremity_count; ++e)
        sum += by_tip(e);
    return sum;
}

EnergyTerms FitEnergy::evaluate(const Posture& posture) const
{
    EnergyTerms terms { place_bones(rig_.skeleton, posture), {}, {}, {}, 0 };
    const Skeleton& joints = terms.bones.joints;
    for (int b = 0; b < bone_count; ++b) {
        terms.by_bone[b] = bone_value(b, joints.head(b), joints.tail(b), terms.bones.parent_turn(b), joints);
        if (metric_.covers(b))
            terms.coverage[b] = coverage_distances(b, joints.head(b), joints.tail(b));
    }
    for (int e = 0; e < extremity_count; ++e)
        terms.by_tip[e] = tip_value(e, terms.bones);
    terms.energy = sum_terms(
        posture, [&](int b) { return terms.by_bone[b]; }, [&](int e) { return terms.by_tip[e]; },
        [&](CoverageDistances& distances, int b) { distances = distances.min(terms.coverage[b]); });
    return terms;
}

double FitEnergy::value(const Posture& posture, const EnergyTerms& near) const
{
    const PlacedBones bones = place_bones(rig_.skeleton, posture, near.bones);
    const Skeleton& joints = bones.joints;
    const Changes changes(near.bones, bones);
    const auto by_bone = [&](int b) {
        return changes.affects_bone(b) ? bone_value(b, joints.head(b), joints.tail(b), bones.parent_turn(b), joints)
                                       : near.by_bone[b];
    };
    const auto by_tip = [&](int e) { return changes.affects_tip(e) ? tip_value(e, bones) : near.by_tip[e]; };
    const auto lower = [&](CoverageDistances& distances, int b) {
        if (changes.has_moved(b))
            distances = distances.min(coverage_distances(b, joints.head(b), joints.tail(b)));
        else
            distances = distances.min(near.coverage[b]);
    };
    return sum_terms(posture, by_bone, by_tip, lower);
}

// A thick bone is tested along its axis and along four lines beside it.
bool FitEnergy::passes_through_cloth(const Vec3& from, const Vec3& to) const
{
    const ClearanceField& cloth = metric_.cloth();
    if (cloth.crosses(from, to))
        return true;
    if (bone_thickness_ <= 0 || from == to)
        return false;
    const Vec3 across = bone_thickness_ * (to - from).unitOrthogonal(), other = (to - from).normalized().cross(across);
    const auto passes_beside = [&](const Vec3& offset) { return cloth.crosses(from + offset, to + offset); };
    return passes_beside(across) || passes_beside(-across) || passes_beside(other) || passes_beside(-other);
}

bool FitEnergy::misses_sleeve(int bone, const Vec3& elbow, const Skeleton& joints) const
{
    if ((bone != lhumerus && bone != rhumerus) || !metric_.covers(bone))
        return false;
    Vec3 nearest = joints.head(lowerback);
    for (const int spine : { lowerback, upperback, thorax })
        if (const Vec3 there = nearest_on_segment(elbow, joints.head(spine), joints.tail(spine));
            (there - elbow).squaredNorm() < (nearest - elbow).squaredNorm())
            nearest = there;
    // the nearest is seen from a level sleeve through its armhole, the waist perhaps from one that is held up
    return !metric_.cloth().crosses(elbow, nearest) && !metric_.cloth().crosses(elbow, joints.head(upperback));
}

double FitEnergy::tip_crossing_cost(const PlacedBones& bones, Extremity extremity) const
{
    const bool crosses = passes_through_cloth(bones.joints.tail(bone_before(extremity)), bones.joints.tips[extremity]);
    return crosses ? (may_cross_cloth(extremity) ? weights_.tip_crossing : weights_.crossing) : 0;
}

int FitEnergy::bones_through_cloth(const Posture& posture) const
{
    const Skeleton joints = place_bones(rig_.skeleton, posture).joints;
    int count = 0;
    for (int b = 0; b < bone_count; ++b)
        count += passes_through_cloth(joints.head(b), joints.tail(b));
    return count;
}

double FitEnergy::crossing_cost(const Posture& posture) const
{
    const PlacedBones bones = place_bones(rig_.skeleton, posture);
    double cost = weights_.crossing * bones_through_cloth(posture);
    for (int e = 0; e < extremity_count; ++e)
        cost += tip_crossing_cost(bones, Extremity(e));
    for (const int arm : { lhumerus, rhumerus })
        cost += misses_sleeve(arm, bones.joints.tail(arm), bones.joints) ? weights_.arm_in_trunk : 0;
    return cost;
}

double FitEnergy::crossing_cost(const Posture& posture, const Limb& limb) const
{
    const PlacedBones bones = place_bones(rig_.skeleton, posture);
    double cost = tip_crossing_cost(bones, limb.end);
    for (const int b : limb.bones) {
        cost += passes_through_cloth(bones.joints.head(b), bones.joints.tail(b)) ? weights_.crossing : 0;
        cost += misses_sleeve(b, bones.joints.tail(b), bones.joints) ? weights_.arm_in_trunk : 0;
    }
    return cost;
}

double FitEnergy::tip_crossing_cost(const Posture& posture) const
{
    const PlacedBones bones = place_bones(rig_.skeleton, posture);
    double cost = 0;
    for (int e = 0; e < extremity_count; ++e)
        cost += may_cross_cloth(Extremity(e)) ? tip_crossing_cost(bones, Extremity(e)) : 0;
    return cost;
}

std::array<double, bone_count> FitEnergy::bone_scores(const Posture& posture) const
{
    const Skeleton joints = place_bones(rig_.skeleton, posture).joints;
    std::array<double, bone_count> scores {};
    for (int b = 0; b < bone_count; ++b)
        if (metric_.covers(b))
            scores[b] = metric_.covered_value(b, joints.head(b), joints.tail(b));
    return scores;
}

double FitEnergy::clearance_share(const Posture& posture) const
{
    const std::array<double, bone_count> scores = bone_scores(posture);
    double needed = 0, found = 0;
    for (int b = 0; b < bone_count; ++b) {
        needed += metric_.covers(b) ? k_samples * metric_.limbs().radii[b] : 0;
        found += std::max(0.0, scores[b]);
    }
    return needed > 0 ? found / needed : 0;
}

}  // namespace garmentfit
