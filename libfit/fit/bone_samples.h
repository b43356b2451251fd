// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The samples at which every metric looks at a bone, and the paper's value of one.

#include "garmentfit/types.h"

namespace garmentfit {

inline constexpr int k_samples = 5;  // literature: [wu_2018_garment_fitting], per bone

/// One of the samples, which are evenly spread on the bone.
inline Vec3 bone_sample(const Vec3& head, const Vec3& tail, int i)
{
    return head + (i + 0.5) / k_samples * (tail - head);
}

inline constexpr double k_paper_outside = -100;  // literature: s of equation (3) [wu_2018_garment_fitting]

/// Equation (3): the distance to the nearest vertex inside, a hundred times its negative outside. `normal` is that
/// vertex's.
inline double paper_delta(const Vec3& sample, const Vec3& nearest, const Vec3& normal)
{
    const Vec3 to_cloth = nearest - sample;
    return (to_cloth.dot(normal) > 0 ? 1 : k_paper_outside) * to_cloth.norm();
}

}  // namespace garmentfit
