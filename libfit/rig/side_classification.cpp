// SPDX-License-Identifier: GPL-3.0-or-later
#include "side_classification.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tuning.h"

namespace garmentfit {
namespace {

using namespace rig_tuning;

/// Evidence: a vector that should point forward, in the trunk's axes, and its weight, 0 to 1.
struct Cue {
    Vec3 forward;
    double weight;
};

/// The component square to `axis`, unit.
Vec3 reject(const Vec3& v, const Vec3& axis) { return v - v.dot(axis) * axis; }

/// Rotates a vector with a bone from direction `from` to direction `to`, without twist.
Vec3 transport(const Vec3& v, const Vec3& from, const Vec3& to)
{
    return Eigen::Quaterniond::FromTwoVectors(from, to) * v;
}

/// Offset of the middle joint from the line from root to end, as a share of its length; 0 for a straight limb.
Vec3 flexion(const LimbJoints& limb)
{
    const Vec3 axis = (limb.end - limb.root).normalized();
    return reject(limb.middle - limb.root, axis) / (limb.end - limb.root).norm();
}

/// Transports a vector at the ankle or the knee along the leg to the trunk.
Vec3 transport_up_leg(const LimbJoints& leg, const Vec3& v, bool at_ankle, const Vec3& down)
{
    const Vec3 thigh = (leg.middle - leg.root).normalized(), shin = (leg.end - leg.middle).normalized();
    return transport(at_ankle ? transport(v, shin, thigh) : v, thigh, down);
}

void add_leg_cues(const LimbJoints& leg, const Vec3& up, double size, std::vector<Cue>& cues)
{
    const Vec3 shin = (leg.end - leg.middle).normalized(), thigh = (leg.middle - leg.root).normalized();
    const Vec3 toes = reject(leg.tip - leg.end, shin);
    const double stick_out = (toes.norm() / size - k_foot_stump) / (k_foot_whole - k_foot_stump);
    cues.push_back({ transport_up_leg(leg, toes.normalized(), true, -up), std::clamp(stick_out, 0.0, 1.0) });
    const Vec3 knee = flexion(leg);
    const Vec3 kneecap = transport_up_leg(leg, reject(knee, thigh).normalized(), false, -up);
    cues.push_back({ kneecap, std::min(1.0, k_knee_weight * knee.norm()) });
    const Vec3 raised = reject(thigh, up);
    cues.push_back({ raised.normalized(), std::clamp(k_hip_weight * (raised.norm() - k_hip_extension), 0.0, 1.0) });
}

void add_arm_cues(const LimbJoints& arm, const Vec3& up, std::vector<Cue>& cues)
{
    const Vec3 off = -reject(flexion(arm), up);  // the forearm flexes forward, so the elbow's offset points backward
    cues.push_back({ off.normalized(), std::min(k_most_elbow_weight, k_elbow_weight * off.norm()) });
}

std::vector<Cue> collect_cues(const BodyJoints& joints, const Vec3& up)
{
    std::vector<Cue> cues;
    for (int i = 0; i < 2; ++i) {
        add_leg_cues(joints.legs[i], up, joints.size, cues);
        add_arm_cues(joints.arms[i], up, cues);
    }
    const Vec3 face = reject(joints.head_off_neck, up);
    cues.push_back({ face.normalized(), std::min(k_most_head_weight, k_head_weight * face.norm() / joints.size) });
    cues.push_back({ joints.legs_front.normalized(), k_profile_weight * joints.legs_front.norm() });
    return cues;
}

}  // namespace

Sides classify_sides(const BodyJoints& joints, const std::optional<Vec3>& known_front)
{
    Sides sides;
    const TrunkAxes axes = trunk_axes(joints);
    sides.up = axes.up;

    const std::vector<Cue> cues
        = known_front ? std::vector<Cue> { { known_front->normalized(), 1 } } : collect_cues(joints, sides.up);
    double evidence = 0, weights = 0;
    for (const Cue& cue : cues) {
        if (!cue.forward.allFinite())
            continue;  // a cue without direction
        evidence += cue.weight * cue.forward.dot(axes.front);
        weights += cue.weight;
    }
    sides.confidence = std::abs(evidence) / std::max(weights, k_whole_evidence);
    if (sides.confidence < k_no_confidence) {
        evidence = axes.front.z();
        sides.confidence = 0;
    }
    sides.left_leg = evidence >= 0 ? 0 : 1;
    sides.left_arm = axes.same_order ? sides.left_leg : 1 - sides.left_leg;
    sides.front = evidence >= 0 ? axes.front : Vec3(-axes.front);
    return sides;
}

}  // namespace garmentfit
