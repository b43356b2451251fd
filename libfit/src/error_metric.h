// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>

#include "posture.h"

namespace fit {

inline constexpr int k_samples = 5;  // a bone [wu_2018_garment_fitting]

/// One of the five points that are evenly spread on a bone.
inline Vec3 bone_sample(const Vec3& head, const Vec3& tail, int i)
{
    return head + (i + 0.5) / k_samples * (tail - head);
}

inline double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b)
{
    const Vec3 ab = b - a, ap = p - a;
    return (ap - std::clamp(ap.dot(ab) / ab.squaredNorm(), 0.0, 1.0) * ab).norm();
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

}  // namespace fit
