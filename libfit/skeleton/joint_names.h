// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace garmentfit {

/// The anatomical meaning of a joint, independent of its name in a file.
enum class JointKind { pelvis, spine, neck, head, clavicle, shoulder, elbow, wrist, hip, knee, ankle };

struct NamedJoint {
    JointKind kind;
    int side = 0;  ///< 0 none, 1 left, 2 right
    bool is_later_part = false;  ///< of a bone in parts: it moves with the first one, at whose head the joint is
};

/// Reads the joint names of Mixamo, Ready Player Me, Unreal, Unity, VRM, MakeHuman, Rigify, Daz, Character Creator, 3ds
/// Max's Biped, CMU, SMPL, Second Life, Quaternius, Auto-Rig Pro and this program; empty for fingers, toes and helper
/// joints. Needs all names of a rig at once: "LeftShoulder" is a clavicle if there is a "LeftArm", otherwise a
/// shoulder, "root" is the pelvis only where no other joint is, and a palm, a fist or the goal "FootIK" of inverse
/// kinematics is a hand or foot only where there is no other. Without a pelvis it is the first joint of the spine. What
/// nearly all names hold, such as "Character1" or "jnt", is left out. Auto-Rig Pro cuts limbs into "twist" and
/// "stretch", which are parts of one bone.
/// @param names  parents first
std::vector<std::optional<NamedJoint>> recognize_joints(const std::vector<std::string>& names);

}  // namespace garmentfit
