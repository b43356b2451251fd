// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Which skin belongs to a hand or foot. These have no bone: their skin is weighted to the bone before them.

#include <algorithm>

#include "garmentfit/skeleton.h"
#include "tuning.h"

namespace garmentfit {

/// The weight of a vertex on a bone.
inline double weight_of(const SkinWeights& weights, Eigen::Index v, int bone)
{
    double sum = 0;
    for (int k = 0; k < 4; ++k)
        if (weights.bones(v, k) == bone)
            sum += weights.weights(v, k);
    return sum;
}

/// The plane that separates the skin of a hand or foot from the skin of the bone before it.
struct ExtremityBend {
    Vec3 joint, tip;
    Vec3 across;  ///< unit normal of the plane that bisects the bend, towards the tip
    bool is_stump;  ///< shorter than a hand or foot
    double blend;  ///< m; within this distance of the plane the share fades

    ExtremityBend(const Skeleton& joints, Extremity end) : joint(joints.tail(bone_before(end))), tip(joints.tips[end])
    {
        const double length = joints.length(bone_before(end));
        is_stump = (tip - joint).norm() < skeleton_tuning::k_shortest_extremity * length;
        blend = skeleton_tuning::k_extremity_blend * length;
        across = ((tip - joint).normalized() + joints.direction(bone_before(end))).normalized();
    }

    /// From 0 before the joint to 1 beyond it.
    double share(const Vec3& p) const
    {
        const double t = std::clamp(0.5 + 0.5 * (p - joint).dot(across) / blend, 0.0, 1.0);
        return t * t * (3 - 2 * t);  // smoothstep
    }
};

}  // namespace garmentfit
