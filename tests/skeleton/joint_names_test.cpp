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

/// A rig as a program names it: pelvis, neck, head; then of the left side clavicle, shoulder, elbow, wrist, hip, knee,
/// ankle. Empty: the program has none.
struct NamedRig {
    const char* program;
    std::vector<std::string> names;
    std::vector<std::string> others;  ///< that must mean none of these
};

const NamedRig k_rigs[] = {
    { "Mixamo",
      { "mixamorig:Hips", "mixamorig:Neck", "mixamorig:Head", "mixamorig:LeftShoulder", "mixamorig:LeftArm",
        "mixamorig:LeftForeArm", "mixamorig:LeftHand", "mixamorig:LeftUpLeg", "mixamorig:LeftLeg",
        "mixamorig:LeftFoot" },
      { "mixamorig:RightArm", "mixamorig:RightShoulder", "mixamorig:LeftHandThumb1", "mixamorig:HeadTop_End",
        "mixamorig:LeftToeBase" } },
    { "Mixamo, its colon lost",
      { "mixamorigHips", "mixamorigNeck", "mixamorigHead", "mixamorigLeftShoulder", "mixamorigLeftArm",
        "mixamorigLeftForeArm", "mixamorigLeftHand", "mixamorigLeftUpLeg", "mixamorigLeftLeg", "mixamorigLeftFoot" },
      { "mixamorigRightArm", "mixamorigRightShoulder" } },
    { "Unreal",
      { "pelvis", "neck_01", "head", "clavicle_l", "upperarm_l", "lowerarm_l", "hand_l", "thigh_l", "calf_l",
        "foot_l" },
      { "root", "ik_foot_root", "ik_hand_l", "upperarm_twist_01_l", "ball_l", "thigh_twist_01_l" } },
    { "Unity",
      { "Hips", "Neck", "Head", "LeftShoulder", "LeftUpperArm", "LeftLowerArm", "LeftHand", "LeftUpperLeg",
        "LeftLowerLeg", "LeftFoot" },
      { "RightShoulder", "RightUpperArm", "LeftToes" } },
    { "VRM 0",
      { "J_Bip_C_Hips", "J_Bip_C_Neck", "J_Bip_C_Head", "J_Bip_L_Shoulder", "J_Bip_L_UpperArm", "J_Bip_L_LowerArm",
        "J_Bip_L_Hand", "J_Bip_L_UpperLeg", "J_Bip_L_LowerLeg", "J_Bip_L_Foot" },
      { "J_Bip_R_Shoulder", "J_Bip_R_UpperArm", "Root", "J_Sec_Hair1_01" } },
    { "Rigify",
      { "DEF-spine", "DEF-spine.004", "DEF-spine.006", "DEF-shoulder.L", "DEF-upper_arm.L", "DEF-forearm.L",
        "DEF-hand.L", "DEF-thigh.L", "DEF-shin.L", "DEF-foot.L" },
      { "DEF-shoulder.R", "DEF-upper_arm.R", "ORG-thigh.L", "MCH-foot.L", "DEF-toe.L" } },
    { "MakeHuman",
      { "root", "neck01", "head", "clavicle.L", "upperarm01.L", "lowerarm01.L", "wrist.L", "upperleg01.L",
        "lowerleg01.L", "foot.L" },
      { "pelvis.L", "toe1-1.L" } },
    { "SMPL-X",
      { "pelvis", "neck", "head", "left_collar", "left_shoulder", "left_elbow", "left_wrist", "left_hip", "left_knee",
        "left_ankle" },
      { "jaw", "left_eye_smplhf", "left_index1" } },
    { "SMPL",
      { "m_avg_Pelvis", "m_avg_Neck", "m_avg_Head", "m_avg_L_Collar", "m_avg_L_Shoulder", "m_avg_L_Elbow",
        "m_avg_L_Wrist", "m_avg_L_Hip", "m_avg_L_Knee", "m_avg_L_Ankle" },
      { "m_avg_root" } },
    { "CMU",
      { "Hips", "Neck", "Head", "LeftShoulder", "LeftArm", "LeftForeArm", "LeftHand", "LeftUpLeg", "LeftLeg",
        "LeftFoot" },
      { "LHipJoint", "RightShoulder", "RightArm", "LThumb" } },
    { "Daz",
      { "pelvis", "neckLower", "head", "lCollar", "lShldrBend", "lForearmBend", "lHand", "lThighBend", "lShin",
        "lFoot" },
      { "lThighTwist", "lForearmTwist", "lToe" } },
    { "3ds Max",
      { "Bip01 Pelvis", "Bip01 Neck", "Bip01 Head", "Bip01 L Clavicle", "Bip01 L UpperArm", "Bip01 L Forearm",
        "Bip01 L Hand", "Bip01 L Thigh", "Bip01 L Calf", "Bip01 L Foot" },
      { "Bip01", "Bip01 L Finger0", "Bip01 Footsteps" } },
    { "Character Creator",
      { "CC_Base_Hip", "CC_Base_NeckTwist01", "CC_Base_Head", "CC_Base_L_Clavicle", "CC_Base_L_Upperarm",
        "CC_Base_L_Forearm", "CC_Base_L_Hand", "CC_Base_L_Thigh", "CC_Base_L_Calf", "CC_Base_L_Foot" },
      { "CC_Base_L_UpperarmTwist01", "CC_Base_L_ToeBase" } },
    { "Quaternius",
      { "Hips", "Neck", "Head", "Shoulder.L", "UpperArm.L", "LowerArm.L", "Palm.L", "UpperLeg.L", "LowerLeg.L",
        "FootIK.L" },
      { "Bone", "PoleTarget.L", "Thumb.L", "MiddleHand.L", "Shoulder.R", "UpperArm.R" } },
    { "Maya",
      { "Character1_Hips", "Character1_Neck", "Character1_Head", "Character1_LeftShoulder", "Character1_LeftArm",
        "Character1_LeftForeArm", "Character1_LeftHand", "Character1_LeftUpLeg", "Character1_LeftLeg",
        "Character1_LeftFoot" },
      { "Character1_Reference", "Character1_LeftToeBase", "Character1_RightShoulder", "Character1_RightArm" } },
    { "a figure by its own name",
      { "EMask_Hips", "EMask_Neck", "EMask_Head", "EMask_LeftShoulder", "EMask_LeftArm", "EMask_LeftForeArm",
        "EMask_LeftHand", "EMask_LeftUpLeg", "EMask_LeftLeg", "EMask_LeftFoot" },
      { "Armature", "EMask_LeftToe_End", "EMask_RightShoulder", "EMask_RightArm" } },
    { "joints by their endings",
      { "pelvis_jnt", "neck_jnt", "head_jnt", "l_clavicle_jnt", "l_upperarm_jnt", "l_forearm_jnt", "l_hand_jnt",
        "l_thigh_jnt", "l_shin_jnt", "l_foot_jnt" },
      { "l_toe_jnt", "l_thumb_01_jnt", "mesh" } },
    { "blocks",
      { "Pelvis", "Neck", "Head", "Shoulder.L", "Arm_Upper.L", "Arm.Lower.L", "Hand.L", "Leg_Upper.L", "Leg_Lower.L",
        "Foot.L" },
      { "Controller", "Hand_IK.L", "Knee_IK.L", "Shoulder.R", "Arm_Upper.R" } },
    { "Second Life",
      { "mPelvis", "mNeck", "mHead", "mCollarLeft", "mShoulderLeft", "mElbowLeft", "mWristLeft", "mHipLeft",
        "mKneeLeft", "mAnkleLeft" },
      { "R_CLAVICLE", "R_UPPER_ARM", "mShoulderRight", "BELLY", "BUTT", "LEFT_PEC", "mToeLeft" } },
    { "Auto-Rig Pro",
      { "root.x", "neck.x", "head.x", "shoulder.l", "arm_stretch.l", "forearm_stretch.l", "hand.l", "thigh_stretch.l",
        "leg_stretch.l", "foot.l" },
      { "shoulder.r", "arm_stretch.r", "toes_01.l", "c_thumb2.l" } },
    { "up and low",
      { "Hips_01", "Neck_05", "Head_06", "Shoulder_L_07", "ArmUp_L_08", "ArmLow_L_09", "Hand_L_010", "LegUp_L_045",
        "LegLow_L_046", "Foot_L_047" },
      { "Shoulder_R_026", "ArmUp_R_027", "Toe_L_048", "Thumb1_L_011" } },
    { "hips before thighs",
      { "Torso", "Neck", "Head", "Shoulder.L", "UpperArm.L", "Forearm.L", "Hand.L", "Thigh.L", "Shin.L", "Foot.L" },
      { "Hip.L", "Hip.R", "Thigh.R", "Shoulder.R", "UpperArm.R", "Toe.L" } },
    { "of one's own",
      { "Hips", "Neck", "Head", "Left shoulder", "Left arm", "Left elbow", "Left wrist", "Left leg", "Left knee",
        "Left ankle" },
      { "Right leg", "Right knee", "Right arm", "Right shoulder" } },
};

TEST(JointNames, RigsOfManyProgramsAreReadWhole)
{
    using enum JointKind;
    const JointKind kinds[] = { pelvis, neck, head, clavicle, shoulder, elbow, wrist, hip, knee, ankle };
    for (const NamedRig& rig : k_rigs) {
        std::vector<std::string> names = rig.names;
        names.insert(names.end(), rig.others.begin(), rig.others.end());
        const auto joints = recognize_joints(names);
        for (std::size_t i = 0; i < rig.names.size(); ++i) {
            ASSERT_TRUE(joints[i]) << rig.program << ' ' << names[i];
            EXPECT_EQ(joints[i]->kind, kinds[i]) << rig.program << ' ' << names[i];
            EXPECT_EQ(joints[i]->side, kinds[i] < clavicle ? 0 : 1) << rig.program << ' ' << names[i];
        }
        for (std::size_t i = rig.names.size(); i < names.size(); ++i)
            EXPECT_FALSE(joints[i] && joints[i]->side < 2) << rig.program << ' ' << names[i];
    }
}

TEST(JointNames, ThePartsOfABoneAreOneJoint)
{
    const std::vector<std::string> names {
        "root.x",          "head.x",          "shoulder.l",        "c_arm_twist_offset.l",
        "arm_stretch.l",   "forearm_twist.l", "forearm_stretch.l", "hand.l",
        "thigh_stretch.l", "thigh_twist.l",   "leg_stretch.l",     "leg_twist.l",
        "shoulder.r",      "arm_stretch.r"
    };
    const auto joints = recognize_joints(names);
    const auto expect_parts = [&](std::size_t first, std::size_t later, JointKind kind) {
        ASSERT_TRUE(joints[first] && joints[later]) << names[first];
        EXPECT_EQ(joints[first]->kind, kind);
        EXPECT_EQ(joints[later]->kind, kind);
        EXPECT_FALSE(joints[first]->is_later_part) << names[first];
        EXPECT_TRUE(joints[later]->is_later_part) << names[later];
    };
    expect_parts(3, 4, JointKind::shoulder);
    expect_parts(6, 5, JointKind::elbow);
    expect_parts(9, 8, JointKind::hip);
    expect_parts(10, 11, JointKind::knee);
    EXPECT_EQ(joints[2]->kind, JointKind::clavicle);
}

TEST(JointNames, TheOnlyBoneOfALegBeginsAtTheHip)
{
    const auto joints = recognize_joints({ "torso", "head", "arm-left", "leg-left", "leg-right" });
    EXPECT_EQ(joints[3]->kind, JointKind::hip);
    EXPECT_EQ(joints[4]->kind, JointKind::hip);
}

TEST(JointNames, FingersToesAndHelpersAreNot)
{
    for (const char* name : { "mixamorig:LeftHandThumb1", "LeftToeBase", "ik_hand_gun", "" })
        EXPECT_FALSE(recognize_joints({ name })[0]) << name;
}

TEST(JointNames, PalmsFistsAndGoalsAreOnlyWhatTheyStandInFor)
{
    const auto joints = recognize_joints({ "hand.L", "palm.01.L", "foot_l", "ik_foot_l" });
    EXPECT_TRUE(joints[0] && joints[2]);
    EXPECT_FALSE(joints[1]);
    EXPECT_FALSE(joints[3]);
    const auto fist = recognize_joints({ "LowerArm.L", "Fist.L" })[1];
    EXPECT_TRUE(fist && fist->kind == JointKind::wrist);
    EXPECT_FALSE(recognize_joints({ "Hand.L", "Fist.L" })[1]);
}

TEST(JointNames, TheFirstOfASpineIsThePelvisWhereNoOtherIs)
{
    const auto joints = recognize_joints({ "Spine", "Spine1", "Head" });
    EXPECT_EQ(joints[0]->kind, JointKind::pelvis);
    EXPECT_EQ(joints[1]->kind, JointKind::spine);
    const auto below_hips = recognize_joints({ "Hips", "Spine", "Spine1", "Head" });
    EXPECT_EQ(below_hips[1]->kind, JointKind::spine);
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
