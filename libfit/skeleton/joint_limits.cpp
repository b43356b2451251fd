// SPDX-License-Identifier: GPL-3.0-or-later
#include "joint_limits.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "posture.h"

namespace garmentfit {
namespace {

constexpr double operator""_deg(long double degrees) { return double(degrees) * std::numbers::pi / 180; }

constexpr double k_straight_spine = 15.0_deg;   // from upright; a body that bends further is straightened to this
constexpr double k_straight_neck = 25.0_deg;
constexpr double k_level_clavicle = 25.0_deg;   // from sideways; arms held up lift it further
constexpr double k_bent_limb = 15.0_deg;        // from here on a bent knee or elbow shows which way it bends

struct Anatomy {
    Vec3 up, front, left;
};

struct Angles {
    double bend_min, bend_max, across_min, across_max;
};

// After the ranges of healthy adults [aaos_1994_joint_motion], widened where a bone stands for several joints; across is
// away from the body's middle. The forearm's width across stands for the twist of the upper arm.
Angles angles_of(int bone)
{
    switch (bone) {
    case lhipjoint: case rhipjoint: return { -5.0_deg, 5.0_deg, -5.0_deg, 5.0_deg };
    case lfemur: case rfemur: return { -25.0_deg, 115.0_deg, -8.0_deg, 50.0_deg };
    case ltibia: case rtibia: return { -5.0_deg, 140.0_deg, -10.0_deg, 10.0_deg };
    case lowerneck: case upperneck: return { -30.0_deg, 35.0_deg, -25.0_deg, 25.0_deg };
    case lclavicle: case rclavicle: return { -15.0_deg, 15.0_deg, -10.0_deg, 20.0_deg };
    case lhumerus: case rhumerus: return { -40.0_deg, 100.0_deg, -45.0_deg, 110.0_deg };
    case lradius: case rradius: return { -8.0_deg, 145.0_deg, -45.0_deg, 45.0_deg };
    default: return { -15.0_deg, 20.0_deg, -15.0_deg, 15.0_deg };
    }
}

bool is_left(int bone) { return bone < mirror_of(bone); }

Anatomy anatomy_of(const Rig& rig)
{
    const Vec3 up = rig.up.normalized();
    Vec3 front = rig.front - rig.front.dot(up) * up;
    front = front.norm() > 1e-6 ? front.normalized() : up.unitOrthogonal();
    return { up, front, up.cross(front) };
}

Vec3 within(double angle, const Vec3& axis, const Vec3& direction)
{
    const double present = angle_between(axis, direction);
    if (present <= angle)
        return direction;
    return Eigen::Quaterniond::Identity().slerp(angle / present, shortest_arc(axis, direction)) * axis;
}

Vec3 across_of(const Vec3& zero, const Vec3& direction)
{
    const Vec3 rest = direction - direction.dot(zero) * zero;
    return rest.norm() > 1e-6 ? rest.normalized() : zero.unitOrthogonal();
}

// Where bones point when the body stands at ease; own axes of the trunk.
Vec3 standing(int bone, const Skeleton& rest, const Anatomy& a)
{
    const Vec3 out = mirror_of(bone) == bone ? Vec3(Vec3::Zero()) : is_left(bone) ? a.left : Vec3(-a.left);
    switch (bone) {
    case lhipjoint: case rhipjoint: return rest.direction(bone);
    case lfemur: case rfemur: return (-a.up + 0.08 * out).normalized();
    case ltibia: case rtibia: return (-a.up + 0.08 * out).normalized();
    case lowerneck: case upperneck: return within(k_straight_neck, (a.up + 0.2 * a.front).normalized(), rest.direction(bone));
    case lclavicle: case rclavicle: return within(k_level_clavicle, out, rest.direction(bone));
    case lhumerus: case rhumerus: case lradius: case rradius: return (out - a.up).normalized();
    default: return within(k_straight_spine, a.up, rest.direction(bone));
    }
}

// Into which side a knee or elbow bends, own axes. A bent one shows it; a straight one is told by the trunk.
Vec3 hinge_direction(int bone, const Skeleton& rest, const Anatomy& a)
{
    const Vec3 upper = rest.direction(parent_of(bone)), lower = rest.direction(bone);
    if (angle_between(upper, lower) > k_bent_limb)
        return across_of(upper, lower);
    if (bone == ltibia || bone == rtibia)
        return across_of(upper, shortest_arc(-a.up, upper) * -a.front);
    return across_of(upper, std::abs(upper.dot(a.front)) < 0.9 ? a.front : a.up);
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
        const Vec3 direction = standing(b, rest, a);
        turns[b] = bone_turn(rest, b, parent_turn, direction);

        const bool hinge = b == ltibia || b == rtibia || b == lradius || b == rradius;
        Range& range = ranges_[b];
        range.zero = hinge ? rest.direction(p) : Vec3(parent_turn.conjugate() * direction);
        range.bend = hinge ? hinge_direction(b, rest, a) : across_of(range.zero, parent_turn.conjugate() * a.front);
        range.across = range.bend.cross(range.zero);
        const Vec3 away = is_left(b) ? a.left : Vec3(-a.left);
        const bool raises = b == lhumerus || b == rhumerus;
        if (range.across.dot(parent_turn.conjugate() * (raises ? Vec3(away + a.up) : away)) < 0)
            range.across = -range.across;
        const Angles angles = angles_of(b);
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
    const double angle = std::acos(along), rest = std::sqrt(std::max(1 - along * along, 1e-18));
    const double bend = angle * local.dot(range.bend) / rest, across = angle * local.dot(range.across) / rest;
    return std::hypot(std::max({ 0.0, range.bend_min - bend, bend - range.bend_max }),
                      std::max({ 0.0, range.across_min - across, across - range.across_max }));
}

}  // namespace garmentfit
