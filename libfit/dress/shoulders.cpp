// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/shoulders.h"

#include "curtain.h"
#include "tuning.h"

namespace garmentfit {
namespace {

Curtain curtain_over(const Skeleton& joints, Bone clavicle)
{
    const double length = joints.length(clavicle);
    return { joints.head(clavicle),
             joints.direction(clavicle),
             joints.direction(thorax),
             { Eigen::Vector2d::Zero(), Eigen::Vector2d((1 + k_beyond_shoulder) * length, length) } };
}

}  // namespace

std::vector<Bone> shoulders_under_cloth(const Skeleton& joints, const Positions& positions, const Triangles& triangles)
{
    return bones_under_cloth(
        { lclavicle, rclavicle }, [&](Bone clavicle) { return curtain_over(joints, clavicle); }, positions, triangles);
}

}  // namespace garmentfit
