// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace garmentfit {

/// What a joint of a rig is, whatever its maker called it.
enum class JointKind { pelvis, spine, neck, head, clavicle, shoulder, elbow, wrist, hip, knee, ankle };

struct NamedJoint {
    JointKind kind;
    int side = 0;  ///< 0 none, 1 left, 2 right
};

/// Reads names as Mixamo, Unreal, VRM, MakeHuman, SMPL and this program give them; nothing for fingers, toes, helpers.
/// All names of a rig at once: "LeftShoulder" is a clavicle where there is a "LeftArm", else a shoulder.
std::vector<std::optional<NamedJoint>> named_joints(const std::vector<std::string>& names);

}  // namespace garmentfit
