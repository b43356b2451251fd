// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Which skin belongs to a hand or foot: no bone of its own moves it, it hangs on the bone before.

#include <algorithm>

#include "garmentfit/skeleton.h"

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

/// A hand or foot, and the bone before it.
struct ExtremityBend {
    Vec3 joint, tip;
    Vec3 across;  ///< unit normal of the plane that halves the bend, towards the tip
    bool is_stump;  ///< too short for a hand or foot
    double blend;  ///< m; so far about the joint, skin belongs partly to it

    ExtremityBend(const Skeleton& joints, Extremity end) : joint(joints.tail(bone_before(end))), tip(joints.tips[end])
    {
        constexpr double k_least = 0.15, k_blend = 0.12;  // of the bone before
        const double length = joints.length(bone_before(end));
        is_stump = (tip - joint).norm() < k_least * length;
        blend = k_blend * length;
        across = ((tip - joint).normalized() + joints.direction(bone_before(end))).normalized();
    }

    /// From 0 before the joint to 1 beyond it.
    double share(const Vec3& p) const
    {
        const double t = std::clamp(0.5 + 0.5 * (p - joint).dot(across) / blend, 0.0, 1.0);
        return t * t * (3 - 2 * t);
    }
};

}  // namespace garmentfit
