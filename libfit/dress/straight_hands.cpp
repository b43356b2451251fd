// SPDX-License-Identifier: GPL-3.0-or-later
#include "straight_hands.h"

#include <algorithm>
#include <cmath>

#include "garmentfit/fit_skeleton.h"

namespace garmentfit {
namespace {

constexpr std::array<Extremity, 2> k_tips { lhand_tip, rhand_tip };
// Half stretched, a hand may be clear of a crumpled cuff, but grows into its folds.
constexpr std::array<double, 2> k_stretches { 0, 1 };

}  // namespace

StraightHands::StraightHands(const Rig& rig, const Positions& own) :
    rig_(rig), own_(own), hands_ { Hand { { rig.skeleton, lhand_tip } }, Hand { { rig.skeleton, rhand_tip } } }
{
    for (int side = 0; side < 2; ++side) {
        const int bone = bone_before(k_tips[side]);
        const ExtremityBend& bend = hands_[side].bend;
        if (bend.is_stump)
            continue;
        hands_[side].turn = Eigen::Quaterniond::FromTwoVectors(bend.tip - bend.joint, rig.skeleton.direction(bone));
        for (Eigen::Index v = 0; v < own.rows(); ++v)
            if (const double share = weight_of(rig.weights, v, bone) * bend.share(own.row(v)); share > 0)
                hands_[side].skin.emplace_back(int(v), share);
    }
}

StraightHands::Stretch StraightHands::clear_of(const GarmentMesh& garment, const Pose& pose) const
{
    Stretch result { 0, 0 };
    std::array<bool, 2> found { false, false };
    for (const double stretch : k_stretches) {
        const Skeleton wished = garmentfit::pose_skeleton(skeleton({ stretch, stretch }), pose),
                       clear = retract_tips(wished, garment);
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
        const Positions here = pose_skeleton({ stretch, stretch }, pose);
        for (int side = 0; side < 2; ++side) {
            double off = 0;
            for (const auto& [v, share] : hands_[side].skin)
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
        for (const auto& [v, share] : hand.skin)
            result.row(v) = hand.bend.joint
                + Eigen::Quaterniond::Identity().slerp(stretch[side] * share, hand.turn)
                    * (own_.row(v).transpose() - hand.bend.joint);
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
            tip = hand.bend.joint
                + Eigen::Quaterniond::Identity().slerp(stretch[side], hand.turn) * (tip - hand.bend.joint);
        }
    return result;
}

Positions StraightHands::pose_skeleton(const Stretch& stretch, const Pose& pose) const
{
    return skin(stretched(stretch), rig_.weights, bone_transforms(rig_.skeleton, pose));
}

}  // namespace garmentfit
