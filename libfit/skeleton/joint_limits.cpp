// SPDX-License-Identifier: GPL-3.0-or-later
#include "joint_limits.h"

#include <algorithm>
#include <cmath>

#include "posture.h"
#include "tuning.h"

namespace garmentfit {
namespace {

using namespace skeleton_tuning;

constexpr double k_no_direction = 1e-6;  // unit: a component of a unit vector below this has no direction

struct Anatomy {
    Vec3 up, front, left;
};

const Angles& angles_of(int bone)
{
    switch (bone) {
    case lhipjoint:
    case rhipjoint: return k_hip_joint_range;
    case lfemur:
    case rfemur: return k_thigh_range;
    case ltibia:
    case rtibia: return k_shin_range;
    case lowerneck:
    case upperneck: return k_neck_range;
    case lclavicle:
    case rclavicle: return k_clavicle_range;
    case lhumerus:
    case rhumerus: return k_upper_arm_range;
    case lradius:
    case rradius: return k_forearm_range;
    default: return k_spine_range;
    }
}

bool is_left(int bone) { return bone < mirror_of(bone); }

Anatomy anatomy_of(const Rig& rig)
{
    const Vec3 up = rig.up.normalized();
    Vec3 front = rig.front - rig.front.dot(up) * up;
    front = front.norm() > k_no_direction ? front.normalized() : up.unitOrthogonal();
    return { up, front, up.cross(front) };
}

/// Rotates a direction towards an axis until the angle between them is at most `angle`, rad.
Vec3 limit_angle(double angle, const Vec3& axis, const Vec3& direction)
{
    const double present = angle_between(axis, direction);
    if (present <= angle)
        return direction;
    return Eigen::Quaterniond::Identity().slerp(angle / present, shortest_arc(axis, direction)) * axis;
}

/// The part of a direction square to `zero`, unit; any such direction if there is none.
Vec3 square_to(const Vec3& zero, const Vec3& direction)
{
    const Vec3 across = direction - direction.dot(zero) * zero;
    return across.norm() > k_no_direction ? across.normalized() : zero.unitOrthogonal();
}

/// Direction of a bone of the standing body, rest axes of the trunk.
Vec3 standing_direction(int bone, const Skeleton& rest, const Anatomy& a)
{
    const Vec3 out = mirror_of(bone) == bone ? Vec3(Vec3::Zero()) : is_left(bone) ? a.left : Vec3(-a.left);
    switch (bone) {
    case lhipjoint:
    case rhipjoint: return rest.direction(bone);
    case lfemur:
    case rfemur: return (-a.up + k_leg_spread * out).normalized();
    case ltibia:
    case rtibia: return (-a.up + k_leg_spread * out).normalized();
    case lowerneck:
    case upperneck:
        return limit_angle(k_straight_neck, (a.up + k_neck_lean * a.front).normalized(), rest.direction(bone));
    case lclavicle:
    case rclavicle: return limit_angle(k_level_clavicle, out, rest.direction(bone));
    case lhumerus:
    case rhumerus:
    case lradius:
    case rradius: return (out - a.up).normalized();
    default: return limit_angle(k_straight_spine, a.up, rest.direction(bone));
    }
}

/// Direction into which a knee or elbow bends, rest axes. A bent limb shows it; for a straight one the trunk determines
/// it.
Vec3 hinge_direction(int bone, const Skeleton& rest, const Anatomy& a)
{
    const Vec3 upper = rest.direction(parent_of(bone)), lower = rest.direction(bone);
    if (angle_between(upper, lower) > k_bent_limb)
        return square_to(upper, lower);
    if (bone == ltibia || bone == rtibia)
        return square_to(upper, shortest_arc(-a.up, upper) * -a.front);
    return square_to(upper, std::abs(upper.dot(a.front)) < k_arm_to_front ? a.front : a.up);
}

}  // namespace

JointLimits::JointLimits(const Rig& rig)
{
    const Skeleton& rest = rig.skeleton;
    const Anatomy a = anatomy_of(rig);
    std::array<Eigen::Quaterniond, bone_count> turns;
    for (int b = 0; b < bone_count; ++b) {
        const int p = parent_of(b);
        const Eigen::Quaterniond parent_turn = p < 0 ? Eigen::Quaterniond::Identity() : turns[p];
        const Vec3 direction = standing_direction(b, rest, a);
        turns[b] = bone_turn(rest, b, parent_turn, direction);

        const bool hinge = b == ltibia || b == rtibia || b == lradius || b == rradius;
        Range& range = ranges_[b];
        range.zero = hinge ? rest.direction(p) : Vec3(parent_turn.conjugate() * direction);
        range.bend = hinge ? hinge_direction(b, rest, a) : square_to(range.zero, parent_turn.conjugate() * a.front);
        range.across = range.bend.cross(range.zero);
        const Vec3 away = is_left(b) ? a.left : Vec3(-a.left);
        const bool raises = b == lhumerus || b == rhumerus;
        if (range.across.dot(parent_turn.conjugate() * (raises ? Vec3(away + a.up) : away)) < 0)
            range.across = -range.across;
        const Angles& angles = angles_of(b);
        range.bend_min = angles.bend_min;
        range.bend_max = angles.bend_max;
        range.across_min = angles.across_min;
        range.across_max = angles.across_max;
    }
}

double JointLimits::excess(int bone, const Eigen::Quaterniond& parent_turn, const Vec3& direction) const
{
    const Range& range = ranges_[bone];
    const Vec3 local = parent_turn.conjugate() * direction;
    const double along = std::clamp(local.dot(range.zero), -1.0, 1.0);
    const double angle = std::acos(along), sine = std::sqrt(std::max(1 - along * along, 1e-18));  // unit: avoids 0 / 0
    const double bend = angle * local.dot(range.bend) / sine, across = angle * local.dot(range.across) / sine;
    return std::hypot(std::max({ 0.0, range.bend_min - bend, bend - range.bend_max }),
                      std::max({ 0.0, range.across_min - across, across - range.across_max }));
}

}  // namespace garmentfit
