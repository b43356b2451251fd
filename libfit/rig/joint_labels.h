// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "body_graph.h"
#include "garmentfit/types.h"
#include "limb_joints.h"

namespace garmentfit {

/// Joints of a body before left and right are known.
struct BodyJoints {
    std::array<LimbJoints, 2> arms, legs;
    Vec3 pelvis, lower_spine, upper_spine, neck_base, mid_neck, skull_base, crown;
    Vec3 head_off_neck = Vec3::Zero();  ///< m, from the neck's centroid to the head's; 0 without a head
    Vec3 legs_front = Vec3::Zero();  ///< by front_of_legs; its length is the certainty, 0 to 1
    double size = 0;  ///< m, estimated stature
};

/// Axes of the trunk, unit, square to each other.
struct TrunkAxes {
    Vec3 up, front;  ///< the front if leg 0 is the left one, else the back
    bool same_order = true;  ///< arm 0 is on the side of leg 0
};

TrunkAxes trunk_axes(const BodyJoints& joints);

/// Places joints on the curves of a body and names them.
/// @throws InvalidInput when a limb has no outline of its own, or a body without head has no hands or feet.
BodyJoints label_joints(const TriangleMesh& proxy, const CurveSkeleton& skeleton, const BodyGraph& graph);

/// Closed clothes without a body look like a body without a head, but their sleeves and legs end narrow.
/// @throws InvalidInput when too few limbs widen to a hand or foot.
void require_hands_or_feet(const BodyJoints& joints);

}  // namespace garmentfit
