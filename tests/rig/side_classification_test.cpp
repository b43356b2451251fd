// SPDX-License-Identifier: GPL-3.0-or-later
#include "side_classification.h"

#include <gtest/gtest.h>

#include "fixtures.h"

namespace {

using namespace garmentfit;

/// Of a person that faces +z. @param left  row of the left limbs
BodyJoints joints_of(const Skeleton& s, int left)
{
    BodyJoints joints;
    joints.arms[left] = { s.tail(lclavicle), s.tail(lhumerus), s.tail(lradius), s.tips[lhand_tip] };
    joints.arms[1 - left] = { s.tail(rclavicle), s.tail(rhumerus), s.tail(rradius), s.tips[rhand_tip] };
    joints.legs[left] = { s.tail(lhipjoint), s.tail(lfemur), s.tail(ltibia), s.tips[lfoot_tip] };
    joints.legs[1 - left] = { s.tail(rhipjoint), s.tail(rfemur), s.tail(rtibia), s.tips[rfoot_tip] };
    joints.pelvis = s.root;
    joints.neck_base = s.tail(thorax);
    joints.size = 1.75;
    return joints;
}

TEST(SideClassification, FindsTheLeftLimbsInEitherOrder)
{
    const Skeleton skeleton = fixtures::person_skeleton({});
    for (const int left : { 0, 1 }) {
        const Sides sides = classify_sides(joints_of(skeleton, left));
        EXPECT_EQ(sides.left_arm, left);
        EXPECT_EQ(sides.left_leg, left);
        EXPECT_GT(sides.front.z(), 0.95);
        EXPECT_GT(sides.confidence, 0.5);
    }
}

TEST(SideClassification, ArmsMayBeInAnotherOrderThanLegs)
{
    BodyJoints joints = joints_of(fixtures::person_skeleton({}), 0);
    std::swap(joints.arms[0], joints.arms[1]);
    const Sides sides = classify_sides(joints);
    EXPECT_EQ(sides.left_leg, 0);
    EXPECT_EQ(sides.left_arm, 1);
}

TEST(SideClassification, AGivenFrontReplacesTheCues)
{
    const Sides sides = classify_sides(joints_of(fixtures::person_skeleton({}), 0), Vec3(0, 0, -1));
    EXPECT_EQ(sides.left_leg, 1);
    EXPECT_LT(sides.front.z(), -0.95);
    EXPECT_GT(sides.confidence, 0.95);
}

BodyJoints without_feet(double elbow_angle, int left)
{
    BodyJoints joints = joints_of(fixtures::person_skeleton({ .elbow_angle = elbow_angle }), left);
    for (LimbJoints& leg : joints.legs) {
        leg.middle = 0.5 * (leg.root + leg.end);
        leg.tip = leg.end;
    }
    return joints;
}

TEST(SideClassification, StraightLimbsWithoutFeetGiveNoEvidence)
{
    EXPECT_LT(classify_sides(without_feet(0, 0)).confidence, 0.2);
}

TEST(SideClassification, WithoutEvidenceTheFrontIsZ)
{
    for (const int left : { 0, 1 }) {
        const Sides sides = classify_sides(without_feet(0, left));
        EXPECT_EQ(sides.left_leg, left);
        EXPECT_GT(sides.front.z(), 0.95);
    }
}

TEST(SideClassification, HardlyAnyEvidenceIsNone)
{
    BodyJoints joints = without_feet(0, 0);
    joints.legs_front = Vec3(0, 0, -0.03);
    const Sides unknown = classify_sides(joints);
    EXPECT_GT(unknown.front.z(), 0.95);
    EXPECT_EQ(unknown.confidence, 0);
    joints.legs_front = Vec3(0, 0, -0.2);
    EXPECT_LT(classify_sides(joints).front.z(), -0.95);
}

TEST(SideClassification, ElbowsThatHardlyBendAreLittleEvidence)
{
    const Sides sides = classify_sides(without_feet(5, 0));
    EXPECT_EQ(sides.left_leg, 0);
    EXPECT_LT(sides.confidence, 0.2);
    EXPECT_GT(classify_sides(without_feet(60, 0)).confidence, 0.2);
}

TEST(SideClassification, TheLegsProfileDecidesWhereNothingElseShows)
{
    for (const double z : { 0.8, -0.8 }) {
        BodyJoints joints = without_feet(0, 0);
        joints.legs_front = Vec3(0, 0, z);
        const Sides sides = classify_sides(joints);
        EXPECT_GT(sides.front.z() * z, 0.7);
        EXPECT_NEAR(sides.confidence, 0.8, 0.05);
    }
}

TEST(SideClassification, FeetOutweighTheLegsProfile)
{
    BodyJoints joints = joints_of(fixtures::person_skeleton({}), 0);
    joints.legs_front = Vec3(0, 0, -1);
    EXPECT_GT(classify_sides(joints).front.z(), 0.95);
}

TEST(SideClassification, StumpsOfShinsAreNoFeet)
{
    BodyJoints joints = without_feet(0, 0);
    for (LimbJoints& leg : joints.legs)
        leg.tip = leg.end + Vec3(0, -0.02, -0.04 * joints.size);
    EXPECT_LT(classify_sides(joints).confidence, 0.2);
}

}  // namespace
