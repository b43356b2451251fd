// SPDX-License-Identifier: GPL-3.0-or-later
#include "collapse.h"

#include <algorithm>

namespace fit {
namespace {

Vec3 nearest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b)
{
    const Vec3 ab = b - a;
    const double length2 = ab.squaredNorm();
    return length2 > 0 ? Vec3(a + std::clamp((p - a).dot(ab) / length2, 0.0, 1.0) * ab) : a;
}

Vec3 nearest_on_bone(const Vec3& p, const Skeleton& skeleton, int bone)
{
    Vec3 nearest = nearest_on_segment(p, skeleton.head(bone), skeleton.tail(bone));
    for (int e = 0; e < extremity_count; ++e)
        if (bone_before(Extremity(e)) == bone) {
            const Vec3 beyond = nearest_on_segment(p, skeleton.tail(bone), skeleton.tips[e]);
            if ((p - beyond).squaredNorm() < (p - nearest).squaredNorm())
                nearest = beyond;
        }
    return nearest;
}

}  // namespace

Positions collapse(const Positions& positions, const SkinWeights& weights, const Skeleton& skeleton)
{
    Positions result = Positions::Zero(positions.rows(), 3);
    for (Eigen::Index v = 0; v < positions.rows(); ++v)
        for (int k = 0; k < 4; ++k)
            if (const double w = weights.weights(v, k); w > 0)
                result.row(v) += w * nearest_on_bone(positions.row(v), skeleton, weights.bones(v, k)).transpose();
    return result;
}

}  // namespace fit
