// SPDX-License-Identifier: GPL-3.0-or-later
#include "posture.h"

#include <gtest/gtest.h>

#include "fixtures.h"

namespace {

using namespace garmentfit;

/// The body rotated and moved, its left arm raised and its right knee bent.
Posture some_posture(const Skeleton& rest)
{
    Posture posture = posture_of(rest, Pose());
    posture.directions[lhumerus] = Vec3(0.5, 0.8, 0.2).normalized();
    posture.directions[rtibia] = Vec3(0, -0.6, -0.8);
    return rotate(posture, Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized())));
}

TEST(Posture, GoesToAPoseAndBack)
{
    const Skeleton rest = fixtures::person_skeleton({});
    const Posture posture = some_posture(rest), again = posture_of(rest, pose_of(rest, posture));
    EXPECT_LT((again.root - posture.root).norm(), 1e-12);
    EXPECT_LT(again.turn.angularDistance(posture.turn), 1e-7);
    for (int b = 0; b < bone_count; ++b)
        EXPECT_LT((again.directions[b] - posture.directions[b]).norm(), 1e-12) << bone_name(b);
}

TEST(Posture, PlacesTheJointsOfItsPose)
{
    const Skeleton rest = fixtures::person_skeleton({});
    const Posture posture = some_posture(rest);
    const Skeleton placed = place_bones(rest, posture).joints, posed = pose_skeleton(rest, pose_of(rest, posture));
    for (int b = 0; b < bone_count; ++b)
        EXPECT_LT((placed.tails[b] - posed.tails[b]).norm(), 1e-12) << bone_name(b);
    for (int e = 0; e < extremity_count; ++e)
        EXPECT_LT((placed.tips[e] - posed.tips[e]).norm(), 1e-12);
}

TEST(Posture, ReusedRotationsGiveTheSameBits)
{
    const Skeleton rest = fixtures::person_skeleton({});
    Posture posture = some_posture(rest);
    const PlacedBones near = place_bones(rest, posture);
    posture.directions[lhumerus] = Vec3(0.9, -0.1, 0.3).normalized();
    const PlacedBones fresh = place_bones(rest, posture), reused = place_bones(rest, posture, near);
    EXPECT_NE(fresh.joints.tails[lradius], near.joints.tails[lradius]);
    EXPECT_EQ(fresh.joints.tails, reused.joints.tails);
    EXPECT_EQ(fresh.joints.tips, reused.joints.tips);
    for (int b = 0; b < bone_count; ++b)
        EXPECT_EQ(fresh.turns[b].coeffs(), reused.turns[b].coeffs()) << bone_name(b);
}

TEST(Posture, TheShortestArcBetweenOppositeDirectionsIsHalfATurn)
{
    const Vec3 from = Vec3(1, 2, 3).normalized();
    EXPECT_LT((shortest_arc(from, -from) * from + from).norm(), 1e-12);
    EXPECT_LT((shortest_arc(from, Vec3::UnitX()) * from - Vec3::UnitX()).norm(), 1e-12);
}

}  // namespace
