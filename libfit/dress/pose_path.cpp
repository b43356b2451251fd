// SPDX-License-Identifier: GPL-3.0-or-later
#include "pose_path.h"

#include <algorithm>

#include "collapse.h"
#include "tuning.h"

namespace garmentfit {

BoneTransforms relative_transforms(const BoneTransforms& from, const BoneTransforms& to)
{
    BoneTransforms result;
    for (int b = 0; b < bone_count; ++b)
        result[b] = to[b] * from[b].inverse();
    return result;
}

PosePath::PosePath(const Rig& rig, const BodyMesh& body, const Pose& from, const Pose& to, const Positions& start,
                   const Positions& cloth, BridgeEnds ends) :
    rig_(rig),
    hands_(rig, body.surface.positions), start_stretch_(hands_.find_stretch(start, from)), from_(from), to_(to),
    end_(at(1)), creases_({ end_, body.surface.triangles }, mark_near_cloth(at(0), cloth), ends)
{
}

BoneTransforms PosePath::transforms(double share) const
{
    return bone_transforms(rig_.skeleton, slerp(from_, to_, share));
}

Positions PosePath::at(double share) const
{
    return skin(hands_.stretch_skin(hand_stretch(share)), rig_.weights, transforms(share));
}

// Hands that were stretched out to put garments on are bent back on the path to the pose of the input.
HandStretch::Shares PosePath::hand_stretch(double share) const
{
    const double left = is_same(to_, Pose()) ? 1 - share : 1;
    return { left * start_stretch_[0], left * start_stretch_[1] };
}

Positions PosePath::bridged_at(double share) const
{
    const BoneTransforms back = relative_transforms(transforms(1), transforms(share));
    const Positions lifted = skin(creases_.bridged_surface(), rig_.weights, back) - skin(end_, rig_.weights, back);
    return at(share) + std::min(1.0, share / k_bridged_from) * lifted;
}

Positions PosePath::withdrawn_end() const
{
    return creases_.withdrawn_surface(collapse(end_, rig_.weights, pose_skeleton(rig_.skeleton, to_)));
}

double PosePath::length(const Positions& cloth, const SkinWeights& weights) const
{
    constexpr int k_chords = 20;  // unit: an arc of 90 degrees is 3e-4 longer than its chords
    const BoneTransforms start = transforms(0);
    double sum = 0;
    Positions before = cloth;
    for (int i = 1; i <= k_chords; ++i) {
        const Positions here = skin(cloth, weights, relative_transforms(start, transforms(double(i) / k_chords)));
        sum += (here - before).rowwise().norm().maxCoeff();
        before = here;
    }
    return sum;
}

}  // namespace garmentfit
