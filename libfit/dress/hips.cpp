// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/hips.h"

#include <limits>

#include "curtain.h"
#include "tuning.h"

namespace garmentfit {
namespace {

Curtain curtain_beside(const Skeleton& joints, Bone hip)
{
    const double far = std::numeric_limits<double>::infinity();
    const Vec3 joint = joints.tail(hip), across = joint - joints.tail(mirror_of(hip));
    return { joint,
             across,
             joints.direction(lowerback),
             { Eigen::Vector2d(0, -k_below_hip * across.norm()), Eigen::Vector2d(far, far) } };
}

}  // namespace

std::vector<Bone> hips_under_cloth(const Skeleton& joints, const Positions& positions, const Triangles& triangles)
{
    return bones_under_cloth(
        { lhipjoint, rhipjoint }, [&](Bone hip) { return curtain_beside(joints, hip); }, positions, triangles);
}

}  // namespace garmentfit
