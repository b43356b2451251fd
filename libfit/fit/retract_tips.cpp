// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "garmentfit/fit_skeleton.h"
#include "nearest.h"
#include "tuning.h"

namespace garmentfit {
namespace {

// Draping needs some distance: the body has some thickness about its bones.
bool is_clear(const TriangleTree& cloth, const Vec3& joint, const Vec3& tip)
{
    const int steps = int(std::ceil((tip - joint).norm() / k_tip_step));
    for (int i = 1; i <= steps; ++i)
        if (cloth.distance(joint + double(i) / steps * (tip - joint)) < k_tip_clearance)
            return false;
    return !cloth.is_met(joint, tip);
}

}  // namespace

Skeleton retract_tips(const Skeleton& joints, const GarmentMesh& garment)
{
    const TriangleTree cloth({ garment.positions, garment.triangles });
    Skeleton result = joints;
    for (int e = 0; e < extremity_count; ++e) {
        const Vec3& joint = joints.tail(bone_before(Extremity(e)));
        double reach = 1;
        while (reach > k_min_tip && !is_clear(cloth, joint, joint + reach * (joints.tips[e] - joint)))
            reach *= k_tip_shrink;
        if (reach < 1)  // shortened once more, to keep some distance
            result.tips[e] = joint + (reach > k_min_tip ? k_tip_shrink * reach : 0.0) * (joints.tips[e] - joint);
    }
    return result;
}

}  // namespace garmentfit
