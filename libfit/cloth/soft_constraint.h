// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "garmentfit/types.h"

namespace garmentfit {

/// Pulls a weighted sum s of up to four vertices to `target` with the energy 1/2 (s - target)^T K (s - target). The
/// stiffness K, N/m, is normal_stiffness along the normal and tangent_stiffness across it. Contact constraints and
/// strain limits have this form.
struct SoftConstraint {
    std::array<int, 4> vertices;  ///< -1: not cloth, its weight does not count
    std::array<double, 4> weights;
    Vec3 target, normal;
    double normal_stiffness, tangent_stiffness;

    Vec3 stiffness_times(const Vec3& s) const
    {
        return tangent_stiffness * s + (normal_stiffness - tangent_stiffness) * normal.dot(s) * normal;
    }
};

}  // namespace garmentfit
