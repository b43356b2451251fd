// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "body_graph.h"
#include "centreline.h"
#include "garmentfit/types.h"

namespace garmentfit {

/// Root, middle and end joint of an arm (shoulder, elbow, wrist) or a leg (hip, knee, ankle), and the tip beyond.
struct LimbJoints {
    Vec3 root, middle, end, tip;
    bool whole = true;  ///< with a hand or a foot
    bool widens = true;  ///< beyond where it is narrowest: then it is surely whole
};

/// Joints of a body before anybody has asked which side is left.
struct BodyJoints {
    std::array<LimbJoints, 2> arms, legs;
    Vec3 pelvis, lower_spine, upper_spine, neck_base, mid_neck, skull_base, crown;
    Vec3 head_off_neck = Vec3::Zero();  ///< m, from the neck's middle to the head's; 0 without a head
    double size = 0;  ///< m, about the stature
};

/// Places joints on the curves: where a limb bends, where its girth is smallest, where it leaves the trunk; and where
/// nothing of that shows, by the segment lengths of [deleva_1996_segments].
/// @throws InvalidInput when a limb has no outline of its own.
BodyJoints label_joints(const TriangleMesh& proxy, const CurveSkeleton& skeleton, const BodyGraph& graph);

}  // namespace garmentfit
