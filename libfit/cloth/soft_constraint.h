// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

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

    /// The weighted sum s of the cloth at x, n x 3.
    Vec3 sum(const Positions& x) const
    {
        Vec3 result = Vec3::Zero();
        for (int k = 0; k < 4; ++k)
            if (vertices[k] >= 0)
                result += weights[k] * x.row(vertices[k]).transpose();
        return result;
    }
};

/// Adds a force on the weighted sum of a constraint to the forces on its vertices, n x 3.
inline void add_force(const SoftConstraint& constraint, const Vec3& force, Positions& forces)
{
    for (int k = 0; k < 4; ++k)
        if (constraint.vertices[k] >= 0)
            forces.row(constraint.vertices[k]) += constraint.weights[k] * force;
}

/// Adds the stiffness of constraints times x, n x 3, or times a displacement.
inline void add_stiffness_times(const std::vector<SoftConstraint>& constraints, const Positions& x, Positions& sum)
{
    for (const SoftConstraint& constraint : constraints)
        add_force(constraint, constraint.stiffness_times(constraint.sum(x)), sum);
}

}  // namespace garmentfit
