// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "joint_labels.h"

namespace garmentfit {

/// The orientation of a body and which of its limbs are left.
struct Sides {
    Vec3 up, front;  ///< of the trunk, unit, square to each other
    int left_arm = 0, left_leg = 0;  ///< rows of BodyJoints::arms and legs
    double confidence = 0;  ///< of the evidence: 0 = low confidence, 1 = all cues agree
};

/// A human is nearly mirror symmetric, so front and back are classified by weighted evidence: toes point forward, knees
/// flex back, hips and elbows flex forward, the face is in front of the neck. Each cue is transported along its limb to
/// the trunk without twist. O(n).
/// Where no cue has any weight, the front is +z, with a confidence of 0.
/// @param known_front  replaces all cues. The confidence then says how well the found limbs agree with it.
Sides classify_sides(const BodyJoints& joints, const std::optional<Vec3>& known_front = {});

}  // namespace garmentfit
