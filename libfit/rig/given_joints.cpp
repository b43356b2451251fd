// SPDX-License-Identifier: GPL-3.0-or-later
#include "given_joints.h"

#include <algorithm>

namespace garmentfit {
namespace {

// literature: [drillis_1966_segments], lengths beyond the last joint as shares of the bone before it. Feet point
// forward.
constexpr double k_head_beyond_neck = 1.2, k_hand_beyond_forearm = 0.7, k_foot_beside_shin = 0.6;

class Correction {
public:
    Correction(const Skeleton& found, const GivenJoints& given) : found_(found), given_(given), result_(found) { }

    Skeleton apply()
    {
        for (int b = 0; b < bone_count; ++b)
            if (given_.tails[b])
                result_.tails[b] = *given_.tails[b];
        for (int e = 0; e < extremity_count; ++e)
            if (given_.tips[e])
                result_.tips[e] = *given_.tips[e];
        result_.root
            = given_.root ? *given_.root : found_.root + 0.5 * (displacement(lhipjoint) + displacement(rhipjoint));
        for (const int b : { lfemur, rfemur, lhumerus, rhumerus })
            adapt(b, displacement(parent_of(b)), displacement(b + 1));
        const Vec3 root = result_.root - found_.root;
        adapt(lowerback, root, displacement(thorax));
        adapt(upperback, displacement(lowerback), displacement(thorax));
        adapt(lowerneck, displacement(thorax), displacement(upperneck));
        return result_;
    }

private:
    Vec3 displacement(int b) const { return result_.tails[b] - found_.tails[b]; }

    /// Moves the joint between two others by a mean of their displacements, weighted towards the nearer one.
    void adapt(int b, const Vec3& before, const Vec3& after)
    {
        if (given_.tails[b])
            return;
        const double upper = found_.length(b), lower = found_.length(b + 1);
        const double t = upper / std::max(upper + lower, 1e-300);  // unit: avoids 0 / 0
        result_.tails[b] += (1 - t) * before + t * after;
    }

    const Skeleton& found_;
    const GivenJoints& given_;
    Skeleton result_;
};

}  // namespace

bool GivenJoints::is_complete() const
{
    return root && std::all_of(tails.begin(), tails.end(), [](const auto& tail) { return tail.has_value(); });
}

Skeleton correct(const Skeleton& found, const GivenJoints& given) { return Correction(found, given).apply(); }

Skeleton skeleton_of(const GivenJoints& given)
{
    Skeleton s;
    s.root = *given.root;
    for (int b = 0; b < bone_count; ++b)
        s.tails[b] = *given.tails[b];
    const Vec3 left = s.tail(lhipjoint) - s.tail(rhipjoint), front = left.cross(s.tail(thorax) - s.root).normalized();
    s.tips[head_top] = s.tail(upperneck) + k_head_beyond_neck * (s.tail(upperneck) - s.tail(thorax));
    for (const Extremity hand : { lhand_tip, rhand_tip })
        s.tips[hand] = s.tail(bone_before(hand))
            + k_hand_beyond_forearm * s.length(bone_before(hand)) * s.direction(bone_before(hand));
    for (const Extremity foot : { lfoot_tip, rfoot_tip })
        s.tips[foot] = s.tail(bone_before(foot)) + k_foot_beside_shin * s.length(bone_before(foot)) * front;
    for (int e = 0; e < extremity_count; ++e)
        s.tips[e] = given.tips[e].value_or(s.tips[e]);
    return s;
}

}  // namespace garmentfit
