// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What users call the joints.

#include <optional>
#include <string_view>

#include "garmentfit/rig_body.h"

namespace garmentfit {

/// Of the joint at the bone's tail: "lhip", "lknee", ...
std::string_view joint_name(Bone bone);
/// "head_top", "lhand_tip", ...
std::string_view joint_name(Extremity tip);
/// Where a joint of that name is kept; "root" is one, too. @throws InvalidInput listing the names.
std::optional<Vec3>& joint_of(GivenJoints& joints, std::string_view name);

}  // namespace garmentfit
