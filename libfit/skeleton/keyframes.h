// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Poses of everyday movement that any rigged body can take: twenty of their own and two walk cycles. Outfits are judged
// by how they follow these, and skin that none of them shows can be left out.

#include <string>
#include <vector>

#include "garmentfit/skeleton.h"

namespace garmentfit {

inline constexpr const char* k_t_pose = "t pose";  ///< the name of that keyframe

struct Keyframe {
    std::string name;
    Pose pose;  ///< away from the rest pose of the rig, whatever that is
};

/// Twenty poses, then eight of a walk and eight of a run. Limbs have the directions of the keyframe in the axes of the
/// body, whatever their rest pose; the trunk bends away from its rest pose. The root stays in place. O(1).
std::vector<Keyframe> keyframes_of(const Rig& rig);

/// Linear blend skinning, as most programs pose what they read; n x 3 in, n x 3 out. O(n).
Positions blend_linearly(const Positions& rest_positions, const SkinWeights& weights, const BoneTransforms& transforms);

}  // namespace garmentfit
