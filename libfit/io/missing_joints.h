// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "gltf_skin.h"
#include "joint_names.h"

namespace garmentfit {

using NamedJoints = std::vector<std::optional<NamedJoint>>;  ///< of each row of a FileSkin

/// The first row of that kind, parents first; -1: none.
int row_of(const NamedJoints& joints, JointKind kind, int side);

/// Adds the elbows, knees, wrists, ankles and the head that a skeleton lacks, because each limb is one bone, fingers hang
/// on the forearm or the foot is one piece with the shin: where the skin of the limb says that they are. Joints without a
/// known name that lie there are taken first. Skin beyond an added elbow or knee hangs on it; the others move nothing.
/// What is called a hand or foot, but lies where elbows or knees do, is one of these.
void add_missing_joints(FileSkin& skin, NamedJoints& joints);

}  // namespace garmentfit
