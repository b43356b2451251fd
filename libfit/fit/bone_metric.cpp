// SPDX-License-Identifier: GPL-3.0-or-later
#include "bone_metric.h"

#include <algorithm>

#include "error_metric.h"
#include "clearance_search.h"
#include "segment.h"

namespace garmentfit {
namespace {

constexpr double k_bare = 2;  // weight of the room that a bare limb lacks
// m per metre of the leg (hip to ankle); an adult's leg has 0.8 m. In the order of Bone.
constexpr std::array<double, bone_count> k_radii { 0.10,  0.085, 0.06, 0.10,  0.085, 0.06, 0.12,  0.12, 0.11,
                                                   0.065, 0.065, 0.06, 0.055, 0.042, 0.06, 0.055, 0.042 };
// of the distance from the last joint to the tip; in the order of Extremity
constexpr std::array<double, extremity_count> k_tip_radii { 0.4, 0.2, 0.2, 0.2, 0.2 };

}  // namespace

Figure figure_of(const Rig& rig, const std::vector<Bone>& covered)
{
    const Skeleton& own = rig.skeleton;
    Figure figure;
    for (const Bone b : covered)
        figure.covered[b] = true;
    const double leg = (own.length(lfemur) + own.length(ltibia) + own.length(rfemur) + own.length(rtibia)) / 2;
    for (int b = 0; b < bone_count; ++b)
        figure.radii[b] = rig.radii[b] > 0 ? rig.radii[b] : k_radii[b] * leg;
    for (int e = 0; e < extremity_count; ++e)
        figure.tip_radii[e] = k_tip_radii[e] * (own.tips[e] - own.tail(bone_before(Extremity(e)))).norm();
    return figure;
}

double BoneMetric::worn(int bone, const Vec3& head, const Vec3& tail) const
{
    double sum = 0;
    for (int i = 0; i < k_samples; ++i)
        sum += clearance_value(cloth_.at(bone_sample(head, tail, i)), figure_.radii[bone]);
    return sum;
}

double BoneMetric::needed(int bone, const Vec3& head, const Vec3& tail) const
{
    double sum = 0;
    for (int i = 0; i < k_samples; ++i) {
        const Clearance clearance = cloth_.at(bone_sample(head, tail, i));
        sum += clearance.inside * std::min(clearance.distance, figure_.radii[bone]);
    }
    return sum;
}

std::array<double, bone_count> BoneMetric::clearance_shares(const Skeleton& joints) const
{
    std::array<double, bone_count> shares {};
    for (int b = 0; b < bone_count; ++b)
        if (figure_.covered[b])
            shares[b] = needed(b, joints.head(b), joints.tail(b)) / (k_samples * figure_.radii[b]);
    return shares;
}

double BoneMetric::bare(int bone, const Vec3& head, const Vec3& tail) const
{
    if (!is_arm(bone) && !is_leg(bone))
        return 0;  // a shirt hangs round hips and neck without covering them
    double sum = 0;
    for (int i = 0; i < k_samples; ++i) {
        const Clearance clearance = cloth_.at(bone_sample(head, tail, i));
        sum += k_bare * std::min(clearance.distance - figure_.radii[bone], 0.0);
        if (is_arm(bone))
            sum -= 0.5 * clearance.inside * figure_.radii[bone];
    }
    return sum;
}

double BoneMetric::bare_tip(Extremity extremity, const Vec3& joint, const Vec3& tip) const
{
    double sum = 0;
    for (int i = 1; i < k_samples; i += 2)  // near the joint, the bone before has had its say
        sum += k_bare * std::min(cloth_.at(bone_sample(joint, tip, i)).distance - figure_.tip_radii[extremity], 0.0);
    return sum;
}

double BoneMetric::overlap(int bone, const Vec3& head, const Vec3& tail, const Skeleton& joints) const
{
    if (bone != lradius && bone != rradius)
        return 0;
    double sum = 0;
    for (int i = 0; i < k_samples; ++i)
        for (const int spine : { lowerback, upperback, thorax }) {
            const double distance
                = distance_to_segment(bone_sample(head, tail, i), joints.head(spine), joints.tail(spine));
            sum += std::max(0.0, figure_.radii[spine] + figure_.radii[bone] - distance);
        }
    return sum;
}

int BoneMetric::samples_inside(const Vec3& head, const Vec3& tail) const
{
    int count = 0;
    for (int i = 0; i < k_samples; ++i)
        count += cloth_.at(bone_sample(head, tail, i)).inside > 0.5;
    return count;
}

}  // namespace garmentfit
