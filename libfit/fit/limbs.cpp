// SPDX-License-Identifier: GPL-3.0-or-later
#include "limbs.h"

#include <algorithm>

#include "tuning.h"

namespace garmentfit {

LimbRadii limb_radii_of(const Rig& rig, const std::vector<Bone>& covered)
{
    const Skeleton& rest = rig.skeleton;
    LimbRadii limbs;
    for (const Bone b : covered)
        limbs.covered[b] = true;
    const double leg = (rest.length(lfemur) + rest.length(ltibia) + rest.length(rfemur) + rest.length(rtibia)) / 2;
    for (int b = 0; b < bone_count; ++b)
        limbs.radii[b] = rig.radii[b] > 0 ? rig.radii[b] : k_limb_radii[b] * leg;
    for (int e = 0; e < extremity_count; ++e)
        limbs.tip_radii[e] = k_tip_radii[e] * (rest.tips[e] - rest.tail(bone_before(Extremity(e)))).norm();
    return limbs;
}

bool is_trunk(int bone)
{
    constexpr std::array<int, 7> trunk { lhipjoint, rhipjoint, lowerback, upperback, thorax, lclavicle, rclavicle };
    return std::find(trunk.begin(), trunk.end(), bone) != trunk.end();
}

}  // namespace garmentfit
