// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Names of the joints, for users.

#include <optional>
#include <string_view>

#include "garmentfit/rig_body.h"

namespace garmentfit {

/// The name of the joint at a bone's tail: "lhip", "lknee", ...
std::string_view joint_name(Bone bone);
/// "head_top", "lhand_tip", ...
std::string_view joint_name(Extremity tip);
/// The joint of that name; "root" is one, too. @throws InvalidInput listing the names.
std::optional<Vec3>& joint_of(GivenJoints& joints, std::string_view name);

}  // namespace garmentfit
