// SPDX-License-Identifier: GPL-3.0-or-later
#include "joint_names.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace {

using namespace garmentfit;

void expect_joint(const std::string& name, JointKind kind, int side)
{
    const auto joint = recognize_joints({ name })[0];
    ASSERT_TRUE(joint) << name;
    EXPECT_EQ(joint->kind, kind) << name;
    EXPECT_EQ(joint->side, side) << name;
}

TEST(JointNames, NamesOfSeveralProgramsAreRecognized)
{
    expect_joint("mixamorig:LeftUpLeg", JointKind::hip, 1);  // Mixamo
    expect_joint("thigh_r", JointKind::hip, 2);  // Unreal
    expect_joint("J_Bip_L_LowerArm", JointKind::elbow, 1);  // VRM
    expect_joint("upperarm01.R", JointKind::shoulder, 2);  // MakeHuman
    expect_joint("left_knee", JointKind::knee, 1);  // SMPL
    expect_joint("rradius", JointKind::elbow, 2);  // this program
    expect_joint("pelvis", JointKind::pelvis, 0);
    expect_joint("L_Hip", JointKind::hip, 1);
}

TEST(JointNames, FingersToesAndHelpersAreNot)
{
    for (const char* name : { "mixamorig:LeftHandThumb1", "LeftToeBase", "ik_hand_gun", "" })
        EXPECT_FALSE(recognize_joints({ name })[0]) << name;
}

TEST(JointNames, AShoulderIsAClavicleBesideAnArm)
{
    const auto alone = recognize_joints({ "LeftShoulder", "RightShoulder", "LeftElbow" });
    EXPECT_EQ(alone[0]->kind, JointKind::shoulder);
    const auto beside = recognize_joints({ "LeftShoulder", "RightShoulder", "LeftArm", "RightArm" });
    EXPECT_EQ(beside[0]->kind, JointKind::clavicle);
    EXPECT_EQ(beside[2]->kind, JointKind::shoulder);
}

}  // namespace
