// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/skeleton.h"

#include <cmath>

#include <gtest/gtest.h>

#include "fixtures.h"

namespace {

using namespace garmentfit;

constexpr double k_tiny = 1e-12;

Eigen::Quaterniond turn(double angle, const Vec3& axis)
{
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis.normalized()));
}

/// Every bone rotated by a small angle about another axis; the root moved and rotated.
Pose some_pose()
{
    Pose pose;
    pose.root_translation = Vec3(0.3, -0.2, 0.1);
    pose.root_rotation = turn(0.8, Vec3(1, 2, 3));
    for (int b = 0; b < bone_count; ++b)
        pose.rotations[b] = turn(0.1 * (b - 8), Vec3(b % 3 - 1, 1, b % 5 - 2));
    return pose;
}

/// Points around each bone, with weights on it and on its parent.
struct Skin {
    Positions positions { 4 * bone_count, 3 };
    SkinWeights weights;
};

Skin some_skin(const Skeleton& skeleton, double weight_on_bone)
{
    Skin skin;
    skin.weights.bones.setZero(4 * bone_count, 4);
    skin.weights.weights.setZero(4 * bone_count, 4);
    for (int v = 0; v < 4 * bone_count; ++v) {
        const int bone = v / 4;
        skin.positions.row(v) = skeleton.head(bone) + 0.02 * Vec3(v % 4 - 1.5, (v + 1) % 3, v % 2);
        skin.weights.bones.row(v) << bone, std::max(parent_of(bone), 0), 0, 0;
        skin.weights.weights.row(v) << weight_on_bone, 1 - weight_on_bone, 0, 0;
    }
    return skin;
}

TEST(Skeleton, EveryBoneFollowsItsParentAndHasAMirror)
{
    for (int b = 0; b < bone_count; ++b) {
        EXPECT_LT(parent_of(b), b);
        EXPECT_EQ(mirror_of(mirror_of(b)), b);
        EXPECT_EQ(bone_of(bone_name(b)), b);
    }
    EXPECT_EQ(bone_of("tail"), -1);
}

TEST(Skeleton, MirrorOfABoneHangsOnTheMirrorOfItsParent)
{
    for (int b = 0; b < bone_count; ++b) {
        const int parent = parent_of(b);
        EXPECT_EQ(parent_of(mirror_of(b)), parent < 0 ? -1 : mirror_of(parent)) << bone_name(b);
    }
}

TEST(Skeleton, BoneBeginsWhereItsParentEnds)
{
    const Skeleton skeleton = fixtures::capsule_person().skeleton;
    EXPECT_EQ(skeleton.head(lowerback), skeleton.root);
    EXPECT_EQ(skeleton.head(lfemur), skeleton.tail(lhipjoint));
    EXPECT_NEAR(skeleton.direction(ltibia).norm(), 1, k_tiny);
}

TEST(Posed, KeepsTheLengthOfEveryBone)
{
    const Skeleton rest = fixtures::capsule_person().skeleton, there = pose_skeleton(rest, some_pose());
    for (int b = 0; b < bone_count; ++b)
        EXPECT_NEAR(there.length(b), rest.length(b), k_tiny) << bone_name(b);
    for (int e = 0; e < extremity_count; ++e) {
        const int b = bone_before(Extremity(e));
        EXPECT_NEAR((there.tips[e] - there.tail(b)).norm(), (rest.tips[e] - rest.tail(b)).norm(), k_tiny);
    }
}

TEST(Posed, InTheRestPoseIsTheSameBitForBit)
{
    const Skeleton rest = fixtures::capsule_person().skeleton, there = pose_skeleton(rest, Pose());
    EXPECT_EQ(there.root, rest.root);
    EXPECT_EQ(there.tails, rest.tails);
    EXPECT_EQ(there.tips, rest.tips);
}

TEST(Posed, BendsAnElbowAndNothingElse)
{
    const Skeleton rest = fixtures::capsule_person().skeleton;
    Pose pose;
    pose.rotations[lradius] = turn(1.0, Vec3::UnitY());
    const Skeleton there = pose_skeleton(rest, pose);
    EXPECT_NEAR(there.direction(lradius).dot(pose.rotations[lradius] * rest.direction(lradius)), 1, k_tiny);
    for (int b = 0; b < bone_count; ++b)
        EXPECT_TRUE(b == lradius || (there.tail(b) - rest.tail(b)).norm() < k_tiny) << bone_name(b);
    EXPECT_GT((there.tips[lhand_tip] - rest.tips[lhand_tip]).norm(), 0.1);
}

TEST(Slerp, StartsAndEndsExactly)
{
    const Pose from = some_pose(), to;
    const Pose at_start = slerp(from, to, 0), at_end = slerp(from, to, 1);
    EXPECT_EQ(at_start.root_translation, from.root_translation);
    EXPECT_EQ(at_end.root_rotation.coeffs(), to.root_rotation.coeffs());
    for (int b = 0; b < bone_count; ++b) {
        EXPECT_EQ(at_start.rotations[b].coeffs(), from.rotations[b].coeffs());
        EXPECT_EQ(at_end.rotations[b].coeffs(), to.rotations[b].coeffs());
    }
}

TEST(Slerp, IsHalfTheTurnHalfWay)
{
    Pose from, to;
    to.rotations[lfemur] = turn(1.2, Vec3::UnitX());
    to.root_translation = Vec3(2, 0, 0);
    const Pose half = slerp(from, to, 0.5);
    EXPECT_NEAR(half.rotations[lfemur].angularDistance(from.rotations[lfemur]), 0.6, 1e-9);
    EXPECT_NEAR(half.root_translation.x(), 1, k_tiny);
}

TEST(Skin, IsTheSameBitForBitInTheRestPose)
{
    const Skeleton rest = fixtures::capsule_person().skeleton;
    const Skin s = some_skin(rest, 0.37);
    EXPECT_EQ(skin(s.positions, s.weights, bone_transforms(rest, Pose())), s.positions);
}

TEST(Skin, MovesRigidlyWithTheWholeBody)
{
    const Skeleton rest = fixtures::capsule_person().skeleton;
    const Skin s = some_skin(rest, 0.37);
    Pose pose;
    pose.root_translation = Vec3(1, 2, 3);
    pose.root_rotation = turn(2.5, Vec3(1, -1, 2));
    const auto transforms = bone_transforms(rest, pose);
    const Positions there = skin(s.positions, s.weights, transforms);
    for (Eigen::Index v = 0; v < there.rows(); ++v)
        EXPECT_LT((transforms[0] * Vec3(s.positions.row(v)) - Vec3(there.row(v))).norm(), 1e-12);
}

TEST(Skin, OnOneBoneFollowsThatBone)
{
    const Skeleton rest = fixtures::capsule_person().skeleton;
    const Skin s = some_skin(rest, 1);
    const auto transforms = bone_transforms(rest, some_pose());
    const Positions there = skin(s.positions, s.weights, transforms);
    for (Eigen::Index v = 0; v < there.rows(); ++v)
        EXPECT_LT((transforms[v / 4] * Vec3(s.positions.row(v)) - Vec3(there.row(v))).norm(), 1e-12);
}

TEST(Skin, KeepsItsDistanceFromATwistedBone)
{
    const Skeleton rest = fixtures::capsule_person().skeleton;
    Pose pose;
    pose.rotations[lradius] = turn(3.0, rest.direction(lradius));  // linear blending would collapse here
    Positions point(1, 3);
    const Vec3 side = rest.direction(lradius).unitOrthogonal();
    point.row(0) = rest.head(lradius) + 0.04 * side;
    SkinWeights weights;
    weights.bones.resize(1, 4);
    weights.weights.resize(1, 4);
    weights.bones << lhumerus, lradius, 0, 0;
    weights.weights << 0.5, 0.5, 0, 0;
    const Positions there = skin(point, weights, bone_transforms(rest, pose));
    EXPECT_NEAR((Vec3(there.row(0)) - rest.head(lradius)).norm(), 0.04, 1e-9);
}

TEST(Skeleton, ABoneWithoutLengthHasADirection)
{
    Skeleton skeleton;
    skeleton.tails.fill(Vec3::Zero());
    EXPECT_EQ(skeleton.length(lclavicle), 0);
    EXPECT_EQ(skeleton.direction(lclavicle).norm(), 1);
}

}  // namespace
