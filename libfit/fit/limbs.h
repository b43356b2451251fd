// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The limbs of a body: which bones form one, how thick they are, and which of them the garment covers.

#include <array>
#include <vector>

#include "garmentfit/skeleton.h"

namespace garmentfit {

struct LimbRadii {
    std::array<bool, bone_count> covered {};
    std::array<bool, bone_count> covered_elsewhere {};  // by another of several garments
    std::array<double, bone_count> radii {};  // m
    std::array<double, extremity_count> tip_radii {};  // m, of head, hands and feet
};

/// The rig's radii, or typical ones where it has none.
LimbRadii limb_radii_of(const Rig& rig, const std::vector<Bone>& covered);

/// Two bones that are searched as one chain, and the extremity after them.
struct Limb {
    std::array<int, 2> bones;
    Extremity end;
};
inline constexpr std::array<Limb, 5> k_limbs { {
    { { lfemur, ltibia }, lfoot_tip },
    { { rfemur, rtibia }, rfoot_tip },
    { { lhumerus, lradius }, lhand_tip },
    { { rhumerus, rradius }, rhand_tip },
    { { lowerneck, upperneck }, head_top },
} };

/// Hips, spine and clavicles.
bool is_trunk(int bone);

inline bool is_left_arm(int bone) { return bone == lhumerus || bone == lradius; }
inline bool is_right_arm(int bone) { return bone == rhumerus || bone == rradius; }
inline bool is_forearm(int bone) { return bone == lradius || bone == rradius; }

/// Ankles and wrists do not bend, so a hand or foot may find no place free of cloth. A head must.
inline bool may_cross_cloth(Extremity extremity) { return extremity != head_top; }

}  // namespace garmentfit
