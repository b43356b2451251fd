// SPDX-License-Identifier: GPL-3.0-or-later
#include "hand_stretch.h"

#include <algorithm>
#include <cmath>

#include "garmentfit/fit_skeleton.h"
#include "tuning.h"

namespace garmentfit {
namespace {

constexpr std::array<Extremity, 2> k_tips { lhand_tip, rhand_tip };

}  // namespace

HandStretch::HandStretch(const Rig& rig, const Positions& input) :
    rig_(rig), input_(input), hands_ { Hand { { rig.skeleton, lhand_tip } }, Hand { { rig.skeleton, rhand_tip } } }
{
    for (int side = 0; side < 2; ++side) {
        const int bone = bone_before(k_tips[side]);
        const ExtremityBend& bend = hands_[side].bend;
        if (bend.is_stump)
            continue;
        hands_[side].turn = Eigen::Quaterniond::FromTwoVectors(bend.tip - bend.joint, rig.skeleton.direction(bone));
        for (Eigen::Index v = 0; v < input.rows(); ++v)
            if (const double share = weight_of(rig.weights, v, bone) * bend.share(input.row(v)); share > 0)
                hands_[side].skin.emplace_back(int(v), share);
    }
}

HandStretch::Shares HandStretch::find_clear_stretch(const GarmentMesh& garment, const Pose& pose) const
{
    Shares result { 0, 0 };
    std::array<bool, 2> found { false, false };
    for (const double stretch : k_hand_stretches) {
        const Skeleton wished = pose_skeleton(stretch_skeleton({ stretch, stretch }), pose),
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

HandStretch::Shares HandStretch::find_stretch(const Positions& left, const Pose& pose) const
{
    Shares result { 0, 0 };
    if (left.rows() == 0)
        return result;
    std::array<double, 2> least { INFINITY, INFINITY };
    for (const double stretch : k_hand_stretches) {
        const Positions posed
            = skin(stretch_skin({ stretch, stretch }), rig_.weights, bone_transforms(rig_.skeleton, pose));
        for (int side = 0; side < 2; ++side) {
            double distance = 0;  // squared, summed
            for (const auto& [v, share] : hands_[side].skin)
                distance += (posed.row(v) - left.row(v)).squaredNorm();
            if (distance < least[side]) {
                least[side] = distance;
                result[side] = stretch;
            }
        }
    }
    return result;
}

Positions HandStretch::stretch_skin(const Shares& shares) const
{
    Positions result = input_;
    for (int side = 0; side < 2; ++side) {
        const Hand& hand = hands_[side];
        if (shares[side] == 0)
            continue;
        for (const auto& [v, share] : hand.skin)
            result.row(v) = hand.bend.joint
                + Eigen::Quaterniond::Identity().slerp(shares[side] * share, hand.turn)
                    * (input_.row(v).transpose() - hand.bend.joint);
    }
    return result;
}

Skeleton HandStretch::stretch_skeleton(const Shares& shares) const
{
    Skeleton result = rig_.skeleton;
    for (int side = 0; side < 2; ++side)
        if (shares[side] > 0 && !hands_[side].skin.empty()) {
            const Hand& hand = hands_[side];
            Vec3& tip = result.tips[k_tips[side]];
            tip = hand.bend.joint
                + Eigen::Quaterniond::Identity().slerp(shares[side], hand.turn) * (tip - hand.bend.joint);
        }
    return result;
}

}  // namespace garmentfit
