// SPDX-License-Identifier: GPL-3.0-or-later
#include "bone_metric.h"

#include <algorithm>

#include "segment.h"

namespace garmentfit {

double BoneMetric::covered_value(int bone, const Vec3& head, const Vec3& tail) const
{
    double sum = 0;
    for (int i = 0; i < k_samples; ++i)
        sum += clearance_value(cloth_.at(bone_sample(head, tail, i)), limbs_.radii[bone]);
    return sum;
}

double BoneMetric::needed_clearance(int bone, const Vec3& head, const Vec3& tail) const
{
    double sum = 0;
    for (int i = 0; i < k_samples; ++i) {
        const Clearance clearance = cloth_.at(bone_sample(head, tail, i));
        sum += clearance.inside * std::min(clearance.distance, limbs_.radii[bone]);
    }
    return sum;
}

std::array<double, bone_count> BoneMetric::clearance_shares(const Skeleton& joints) const
{
    std::array<double, bone_count> shares {};
    for (int b = 0; b < bone_count; ++b)
        if (covers(b))
            shares[b] = needed_clearance(b, joints.head(b), joints.tail(b)) / (k_samples * limbs_.radii[b]);
    return shares;
}

double BoneMetric::uncovered_value(int bone, const Vec3& head, const Vec3& tail) const
{
    if (!is_arm(bone) && !is_leg(bone))
        return 0;  // a shirt hangs round hips and neck without covering them
    double sum = 0;
    for (int i = 0; i < k_samples; ++i) {
        const Clearance clearance = cloth_.at(bone_sample(head, tail, i));
        sum += weights_.uncovered_clearance * std::min(clearance.distance - limbs_.radii[bone], 0.0);
        if (is_arm(bone))
            sum -= weights_.uncovered_arm_inside * clearance.inside * limbs_.radii[bone];
    }
    return sum;
}

double BoneMetric::uncovered_tip_value(Extremity extremity, const Vec3& joint, const Vec3& tip) const
{
    double sum = 0;
    for (int i = 1; i < k_samples; i += 2)  // the sample next to the joint is nearly one of the bone before
        sum += weights_.uncovered_clearance
            * std::min(cloth_.at(bone_sample(joint, tip, i)).distance - limbs_.tip_radii[extremity], 0.0);
    return sum;
}

double BoneMetric::trunk_overlap(int bone, const Vec3& head, const Vec3& tail, const Skeleton& joints) const
{
    if (!is_forearm(bone))
        return 0;
    double sum = 0;
    for (int i = 0; i < k_samples; ++i)
        for (const int spine : { lowerback, upperback, thorax }) {
            const double distance
                = distance_to_segment(bone_sample(head, tail, i), joints.head(spine), joints.tail(spine));
            sum += std::max(0.0, limbs_.radii[spine] + limbs_.radii[bone] - distance);
        }
    return sum;
}

int BoneMetric::samples_inside(const Vec3& head, const Vec3& tail) const
{
    int count = 0;
    for (int i = 0; i < k_samples; ++i)
        count += cloth_.at(bone_sample(head, tail, i)).is_inside();
    return count;
}

}  // namespace garmentfit
