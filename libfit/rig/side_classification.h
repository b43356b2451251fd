// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "joint_labels.h"

namespace garmentfit {

/// Which way a body faces and which of its limbs are left.
struct Sides {
    Vec3 up, front;  ///< of the trunk, unit, square to each other
    int left_arm = 0, left_leg = 0;  ///< rows of BodyJoints::arms and legs
    double margin = 0;  ///< 0 (a guess) to 1 (every cue agrees)
};

/// A human is nearly its own mirror image, so cues vote: toes point forward, knees flex back, hips flex forward, elbows
/// flex forward, the face is in front of the neck. Each is carried to the trunk along its limb without twist. O(n).
/// @param known_front  ends the vote: the sides are those that face it best, the margin says how well
Sides classify_sides(const BodyJoints& joints, const std::optional<Vec3>& known_front = {});

}  // namespace garmentfit
