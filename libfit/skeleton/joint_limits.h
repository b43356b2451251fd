// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What poses a human can take.
//
// Each bone has a zero direction, a direction into which it bends, and one across, in the own axes of the bone it hangs on;
// its range is a box of angles along the two. Zero is a standing body with its arms held away from the trunk.

#include <array>

#include "garmentfit/skeleton.h"

namespace garmentfit {

class JointLimits {
public:
    explicit JointLimits(const Rig& rig);

    /// Where a bone points when the body stands at ease; `parent_turn` as in PlacedBones.
    Vec3 at_ease(int bone, const Eigen::Quaterniond& parent_turn) const { return parent_turn * ranges_[bone].zero; }

    /// How far a direction lies beyond the bone's range, radians; 0 within.
    double excess(int bone, const Eigen::Quaterniond& parent_turn, const Vec3& direction) const;

private:
    struct Range {
        Vec3 zero, bend, across;  // unit, own axes of the parent
        double bend_min, bend_max, across_min, across_max;  // radians
    };
    std::array<Range, bone_count> ranges_;
};

/// [wu_2018_garment_fitting]: a forearm keeps within a right angle of its clavicle, or it would fold into the chest.
inline bool folds_into_chest(const Vec3& clavicle, const Vec3& forearm) { return clavicle.dot(forearm) < 0; }

}  // namespace garmentfit
