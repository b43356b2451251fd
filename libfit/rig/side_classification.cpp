// SPDX-License-Identifier: GPL-3.0-or-later
#include "side_classification.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace garmentfit {
namespace {

constexpr double k_stump
    = 0.03;  // of stature: no further do the ends of legs without feet stick out, toes twice as far

/// One piece of evidence: a vector that should point forward, in the trunk's axes. Its weight is how far it can be trusted.
struct Cue {
    Vec3 forward;
    double weight;
};

Vec3 without(const Vec3& v, const Vec3& axis) { return v - v.dot(axis) * axis; }

/// Turns a vector that sits on a bone along `from` to where it sits when that bone is turned along `to`, without twist.
Vec3 carried(const Vec3& v, const Vec3& from, const Vec3& to)
{
    return Eigen::Quaterniond::FromTwoVectors(from, to) * v;
}

/// How far the middle joint stands off the line from root to end, towards where it stands off; 0 for a straight limb.
Vec3 flexion(const LimbJoints& limb)
{
    const Vec3 axis = (limb.end - limb.root).normalized();
    return without(limb.middle - limb.root, axis) / (limb.end - limb.root).norm();
}

/// A vector at the ankle or the knee, carried up the straightened leg to the trunk.
Vec3 carried_up_leg(const LimbJoints& leg, const Vec3& v, bool at_ankle, const Vec3& down)
{
    const Vec3 thigh = (leg.middle - leg.root).normalized(), shin = (leg.end - leg.middle).normalized();
    return carried(at_ankle ? carried(v, shin, thigh) : v, thigh, down);
}

void add_leg_cues(const LimbJoints& leg, const Vec3& up, double size, std::vector<Cue>& cues)
{
    const Vec3 shin = (leg.end - leg.middle).normalized(), thigh = (leg.middle - leg.root).normalized();
    const Vec3 toes = without(leg.tip - leg.end, shin);
    const double stick_out = (toes.norm() / size - k_stump) / k_stump;
    cues.push_back({ carried_up_leg(leg, toes.normalized(), true, -up), std::clamp(stick_out, 0.0, 1.0) });
    const Vec3 knee = flexion(leg);
    const Vec3 kneecap = carried_up_leg(leg, without(knee, thigh).normalized(), false, -up);
    cues.push_back({ kneecap, std::min(1.0, 6 * knee.norm()) });
    const Vec3 raised = without(thigh, up);  // a hip flexes by 120 degrees, and stretches by 20
    cues.push_back({ raised.normalized(), std::clamp(2 * (raised.norm() - 0.35), 0.0, 1.0) });
}

void add_arm_cues(const LimbJoints& arm, const Vec3& up, std::vector<Cue>& cues)
{
    const Vec3 off = -without(flexion(arm), up);  // the forearm folds forward, so the elbow stands off backward
    cues.push_back({ off.normalized(), std::min(0.5, 2 * off.norm()) });
}

std::vector<Cue> cues_of(const BodyJoints& joints, const Vec3& up)
{
    std::vector<Cue> cues;
    for (int i = 0; i < 2; ++i) {
        add_leg_cues(joints.legs[i], up, joints.size, cues);
        add_arm_cues(joints.arms[i], up, cues);
    }
    const Vec3 face = without(joints.head_off_neck, up);
    cues.push_back({ face.normalized(), std::min(0.5, 25 * face.norm() / joints.size) });
    return cues;
}

}  // namespace

Sides classify_sides(const BodyJoints& joints, const std::optional<Vec3>& known_front)
{
    Sides sides;
    sides.up = (joints.neck_base - joints.pelvis).normalized();
    const Vec3 hips = without(joints.legs[0].root - joints.legs[1].root, sides.up).normalized();
    const Vec3 shoulders = without(joints.arms[0].root - joints.arms[1].root, sides.up).normalized();
    const bool same_order = hips.dot(shoulders) > 0;
    const Vec3 across = (hips + (same_order ? 1 : -1) * shoulders).normalized();  // from leg 1 to leg 0
    const Vec3 front = across.cross(sides.up).normalized();  // if leg 0 is the left one

    const std::vector<Cue> cues
        = known_front ? std::vector<Cue> { { known_front->normalized(), 1 } } : cues_of(joints, sides.up);
    double votes = 0, weights = 0;
    for (const Cue& cue : cues) {
        if (!cue.forward.allFinite())
            continue;
        votes += cue.weight * cue.forward.dot(front);
        weights += cue.weight;
    }
    sides.left_leg = votes >= 0 ? 0 : 1;
    sides.left_arm = same_order ? sides.left_leg : 1 - sides.left_leg;
    sides.front = votes >= 0 ? front : Vec3(-front);
    sides.margin = weights > 0 ? std::abs(votes) / weights : 0;
    return sides;
}

}  // namespace garmentfit
