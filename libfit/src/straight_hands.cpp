// SPDX-License-Identifier: GPL-3.0-or-later
#include "straight_hands.h"

#include <algorithm>
#include <cmath>

#include "fit/fit_skeleton.h"

namespace fit {
namespace {

constexpr std::array<Extremity, 2> k_tips { lhand_tip, rhand_tip };
// Half stretched, a hand may be clear of a crumpled cuff, but grows into its folds.
constexpr std::array<double, 2> k_stretches { 0, 1 };
// Of the forearm: shorter than that is a stump; and so far about the wrist skin takes part in its bend.
constexpr double k_least_hand = 0.15, k_blend = 0.12;

double weight_of(const SkinWeights& weights, Eigen::Index v, int bone)
{
    double sum = 0;
    for (int k = 0; k < 4; ++k)
        if (weights.bones(v, k) == bone)
            sum += weights.weights(v, k);
    return sum;
}

double smooth_step(double x)
{
    const double t = std::clamp(x, 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

}  // namespace

StraightHands::StraightHands(const Rig& rig, const Positions& own) : rig_(rig), own_(own)
{
    for (int side = 0; side < 2; ++side) {
        const int bone = bone_before(k_tips[side]);
        Hand& hand = hands_[side];
        hand.wrist = rig.skeleton.tail(bone);
        const Vec3 fingers = rig.skeleton.tips[k_tips[side]] - hand.wrist, forearm = rig.skeleton.direction(bone);
        if (fingers.norm() < k_least_hand * rig.skeleton.length(bone))
            continue;
        hand.across = (fingers.normalized() + forearm).normalized();
        hand.turn = Eigen::Quaterniond::FromTwoVectors(fingers, forearm);
        hand.blend = k_blend * rig.skeleton.length(bone);
        for (Eigen::Index v = 0; v < own.rows(); ++v)
            if (const double weight = weight_of(rig.weights, v, bone);
                weight > 0 && (own.row(v).transpose() - hand.wrist).dot(hand.across) > -hand.blend)
                hand.skin.emplace_back(int(v), weight);
    }
}

StraightHands::Stretch StraightHands::clear_of(const GarmentMesh& garment, const Pose& pose) const
{
    Stretch result { 0, 0 };
    std::array<bool, 2> found { false, false };
    for (const double stretch : k_stretches) {
        const Skeleton wished = fit::posed(skeleton({ stretch, stretch }), pose),
                       clear = with_clear_tips(wished, garment);
        for (int side = 0; side < 2; ++side)
            if (!found[side] && clear.tips[k_tips[side]] == wished.tips[k_tips[side]]) {
                found[side] = true;
                result[side] = stretch;
            }
        if (found[0] && found[1])
            break;
    }
    return result;
}

StraightHands::Stretch StraightHands::of(const Positions& left, const Pose& pose) const
{
    Stretch result { 0, 0 };
    if (left.rows() == 0)
        return result;
    std::array<double, 2> least { INFINITY, INFINITY };
    for (const double stretch : k_stretches) {
        const Positions here = posed({ stretch, stretch }, pose);
        for (int side = 0; side < 2; ++side) {
            double off = 0;
            for (const auto& [v, weight] : hands_[side].skin)
                off += (here.row(v) - left.row(v)).squaredNorm();
            if (off < least[side]) {
                least[side] = off;
                result[side] = stretch;
            }
        }
    }
    return result;
}

Positions StraightHands::stretched(const Stretch& stretch) const
{
    Positions result = own_;
    for (int side = 0; side < 2; ++side) {
        const Hand& hand = hands_[side];
        if (stretch[side] == 0)
            continue;
        for (const auto& [v, weight] : hand.skin) {
            const Vec3 from_wrist = own_.row(v).transpose() - hand.wrist;
            const double beyond = smooth_step(0.5 + 0.5 * from_wrist.dot(hand.across) / hand.blend);
            const Eigen::Quaterniond none = Eigen::Quaterniond::Identity();
            result.row(v) = hand.wrist + none.slerp(stretch[side] * weight * beyond, hand.turn) * from_wrist;
        }
    }
    return result;
}

Skeleton StraightHands::skeleton(const Stretch& stretch) const
{
    Skeleton result = rig_.skeleton;
    for (int side = 0; side < 2; ++side)
        if (stretch[side] > 0 && !hands_[side].skin.empty()) {
            const Hand& hand = hands_[side];
            Vec3& tip = result.tips[k_tips[side]];
            tip = hand.wrist + Eigen::Quaterniond::Identity().slerp(stretch[side], hand.turn) * (tip - hand.wrist);
        }
    return result;
}

Positions StraightHands::posed(const Stretch& stretch, const Pose& pose) const
{
    return skin(stretched(stretch), rig_.weights, bone_transforms(rig_.skeleton, pose));
}

}  // namespace fit
