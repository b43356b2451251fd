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

/// Adds the wrists, ankles and the head that a skeleton lacks, because fingers hang on the forearm, say, or the foot is
/// one piece with the shin: where the skin of the last joint of that limb says that they are. They move nothing.
void add_missing_ends(FileSkin& skin, NamedJoints& joints);

}  // namespace garmentfit
