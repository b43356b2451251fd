// SPDX-License-Identifier: GPL-3.0-or-later
#include "posture_moves.h"

#include "search_grids.h"

namespace garmentfit {
namespace {

// Placed before limbs are searched: legs hang below the hips, arms may point anywhere.
constexpr std::array<int, 9> k_placed_first { lhipjoint, rhipjoint, lowerback, upperback, thorax,
                                              lclavicle, rclavicle, lfemur,    rfemur };

// A slim body may find clearance for both legs in one leg of wide trousers: its root stays between the two.
Slab slab_between_legs(const GarmentCues& cues)
{
    if (cues.hems.empty())
        return {};
    const Vec3 apart = cues.hems[1] - cues.hems[0];
    return { 0.5 * (cues.hems[0] + cues.hems[1]), apart.stableNormalized(), k_between_legs * apart.norm() };
}

}  // namespace

Posture comfort_posture(const FitEnergy& energy, const Vec3& root, const Eigen::Quaterniond& turn)
{
    Posture posture { root, turn, {} };
    std::array<Eigen::Quaterniond, bone_count> turns;
    for (int b = 0; b < bone_count; ++b) {
        const Eigen::Quaterniond parent_turn = parent_of(b) < 0 ? turn : turns[parent_of(b)];
        posture.directions[b] = energy.limits().comfort_direction(b, parent_turn);
        turns[b] = bone_turn(energy.rest(), b, parent_turn, posture.directions[b]);
    }
    return posture;
}

Posture input_posture(const Skeleton& rest, const Vec3& shift)
{
    Posture posture { rest.root + shift, Eigen::Quaterniond::Identity(), {} };
    for (int b = 0; b < bone_count; ++b)
        posture.directions[b] = rest.direction(b);
    return posture;
}

std::vector<Place> find_trunk_places(const FitEnergy& energy, const MinMaxPyramid& clearance, const Posture& posture)
{
    const BoneMetric& metric = energy.metric();
    Posture at_origin = posture;
    at_origin.root = Vec3::Zero();
    const Skeleton joints = place_bones(energy.rest(), at_origin).joints;
    std::vector<ClearanceSample> samples;
    for (const int b : k_placed_first)
        for (int i = 0; i < k_samples && metric.covers(b); i += 2)  // of five: both ends and the middle suffice here
            samples.push_back({ bone_sample(joints.head(b), joints.tail(b), i), metric.limbs().radii[b] });
    const ClearanceField& cloth = metric.cloth();
    const double below = energy.hangs_from_shoulders() ? (joints.tail(thorax) - joints.root).norm() : 0;
    return ClearanceSearch(clearance, samples, energy.hang_slope() * Vec3::UnitY(), slab_between_legs(energy.cues()))
        .find_best(cloth.low() - k_hem_reach * below * Vec3::UnitY(), cloth.high(), k_place_spacing, k_places_apart,
                   k_places_per_hypothesis);
}

// A rotation about the root would move the shoulders out of a shirt.
Posture rotate_about_trunk(const FitEnergy& energy, const Posture& present, const Vec3& rotation_vector)
{
    const Skeleton joints = place_bones(energy.rest(), present).joints;
    const Vec3 centre = energy.hangs_from_shoulders() ? joints.tail(thorax) : joints.root;
    const Eigen::Quaterniond turn = rotation_by(rotation_vector);
    Posture moved = present;
    moved.root = centre + turn * (present.root - centre);
    moved.turn = (turn * present.turn).normalized();
    for (Vec3& direction : moved.directions)
        direction = turn * direction;
    return moved;
}

Posture mirror_limb(const Rig& rig, const Posture& present, const Limb& limb)
{
    const Vec3 left = present.turn * rig.up.cross(rig.front).normalized();
    Posture moved = present;
    for (const int b : limb.bones)
        moved.directions[b] = reflect(present.directions[mirror_of(b)], left);
    return moved;
}

}  // namespace garmentfit
