// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>

#include "posture.h"

namespace garmentfit {

inline constexpr int k_samples = 5;  // a bone [wu_2018_garment_fitting]

/// One of the five points that are evenly spread on a bone.
inline Vec3 bone_sample(const Vec3& head, const Vec3& tail, int i)
{
    return head + (i + 0.5) / k_samples * (tail - head);
}

/// How well a placed skeleton suits a garment: what the relaxed search raises. May be asked from several threads.
class ErrorMetric {
public:
    virtual ~ErrorMetric() = default;

    /// E, of the whole skeleton.
    virtual double total(const PlacedBones& bones) const = 0;
    /// E_B, what turning one bone is judged by.
    virtual double of_bone(int bone, const PlacedBones& bones) const = 0;
};

}  // namespace garmentfit
