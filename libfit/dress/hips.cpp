// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/hips.h"

#include <algorithm>
#include <limits>

#include "curtain.h"
#include "nearest.h"
#include "tuning.h"

namespace garmentfit {
namespace {

Curtain curtain_beside(const Skeleton& joints, Bone hip, double crotch)
{
    const double far = std::numeric_limits<double>::infinity();
    const Vec3 joint = joints.tail(hip), across = joint - joints.tail(mirror_of(hip));
    const double below = std::max(k_below_hip * across.norm(), k_towards_crotch * crotch);
    return { joint, across, joints.direction(lowerback), { Eigen::Vector2d(0, -below), Eigen::Vector2d(far, far) } };
}

}  // namespace

double crotch_depth(const Skeleton& joints, const TriangleMesh& closed)
{
    const Vec3 middle = 0.5 * (joints.tail(lhipjoint) + joints.tail(rhipjoint));
    const auto hit = TriangleTree(closed).first_hit(middle, -joints.direction(lowerback));
    const double knee = std::min(joints.length(lfemur), joints.length(rfemur));
    return hit && hit->from_behind && hit->distance < knee ? hit->distance : 0;
}

std::vector<Bone> hips_under_cloth(const Skeleton& joints, double crotch, const Positions& positions,
                                   const Triangles& triangles)
{
    return bones_under_cloth(
        { lhipjoint, rhipjoint }, [&](Bone hip) { return curtain_beside(joints, hip, crotch); }, positions, triangles);
}

}  // namespace garmentfit
