// SPDX-License-Identifier: GPL-3.0-or-later
#include "keyframes.h"

#include <gtest/gtest.h>

#include "fixtures.h"
#include "posture.h"

namespace {

using namespace garmentfit;
using namespace garmentfit::fixtures;

Skeleton posed(const Rig& rig, const std::string& name)
{
    for (const Keyframe& key : keyframes_of(rig))
        if (key.name == name)
            return pose_skeleton(rig.skeleton, key.pose);
    throw std::out_of_range(name);
}

TEST(Keyframes, AreTwentyPosesAndTwoCycles)
{
    const Rig rig = simple_rig(capsule_person());
    const std::vector<Keyframe> keys = keyframes_of(rig);
    ASSERT_EQ(keys.size(), 36u);
    for (std::size_t a = 0; a < keys.size(); ++a)
        for (std::size_t b = 0; b < a; ++b)
            EXPECT_NE(keys[a].name, keys[b].name);
}

TEST(Keyframes, PointLimbsAlikeWhateverTheRestPose)
{
    const Rig t_pose = simple_rig(capsule_person({ .arm_angle = 0 })),
              bent = simple_rig(capsule_person({ .arm_angle = 70, .elbow_angle = 60, .knee_angle = 40 }));
    for (const char* name : { "stand", "arms up", "sit", "bow", "run 4" }) {
        const Skeleton one = posed(t_pose, name), other = posed(bent, name);
        for (const int bone : { lfemur, ltibia, rfemur, rtibia, lhumerus, lradius, rhumerus, rradius })
            EXPECT_LT(angle_between(one.direction(bone), other.direction(bone)), 1e-6) << name << bone_name(bone);
    }
}

TEST(Keyframes, FollowTheAxesOfTheBody)
{
    Rig rig = simple_rig(capsule_person());
    const Skeleton front = posed(rig, "reach up");
    EXPECT_GT(front.direction(lhumerus).y(), 0.7);  // the left arm, not the right one
    EXPECT_LT(front.direction(rhumerus).y(), -0.7);
    EXPECT_GT(posed(rig, "sit").direction(lfemur).z(), 0.9);
    EXPECT_LT(posed(rig, "bow").direction(thorax).y(), 0.7);

    const Eigen::Quaterniond turn(Eigen::AngleAxisd(1.1, Vec3(0.3, 1, -0.4).normalized()));
    Rig turned = rig;
    turned.skeleton.root = turn * rig.skeleton.root;
    for (Vec3& tail : turned.skeleton.tails)
        tail = turn * tail;
    for (Vec3& tip : turned.skeleton.tips)
        tip = turn * tip;
    turned.up = turn * rig.up;
    turned.front = turn * rig.front;
    const std::vector<Keyframe> keys = keyframes_of(rig), turned_keys = keyframes_of(turned);
    for (std::size_t k = 0; k < keys.size(); ++k) {
        const Skeleton one = pose_skeleton(rig.skeleton, keys[k].pose),
                       other = pose_skeleton(turned.skeleton, turned_keys[k].pose);
        for (int bone = 0; bone < bone_count; ++bone)
            EXPECT_LT((turn * one.tail(bone) - other.tail(bone)).norm(), 1e-6) << keys[k].name << bone_name(bone);
    }
}

TEST(Keyframes, LinearBlendingMovesRigidPartsRigidlyAndAveragesOthers)
{
    const Skeleton skeleton = person_skeleton({});
    Pose pose;
    pose.rotations[lradius] = Eigen::AngleAxisd(1.2, Vec3::UnitY());
    const BoneTransforms transforms = bone_transforms(skeleton, pose);
    Positions points(2, 3);
    points << skeleton.tail(lradius).transpose(), skeleton.tail(lradius).transpose();
    SkinWeights weights;
    weights.bones.setZero(2, 4);
    weights.weights.setZero(2, 4);
    weights.bones.row(0) << lradius, 0, 0, 0;
    weights.weights.row(0) << 1, 0, 0, 0;
    weights.bones.row(1) << lradius, lhumerus, 0, 0;
    weights.weights.row(1) << 0.5, 0.5, 0, 0;
    const Positions moved = blend_linearly(points, weights, transforms);
    EXPECT_LT((moved.row(0).transpose() - pose_skeleton(skeleton, pose).tail(lradius)).norm(), 1e-12);
    EXPECT_LT((moved.row(1) - (moved.row(0) + points.row(1)) / 2).norm(), 1e-12);
}

}  // namespace
