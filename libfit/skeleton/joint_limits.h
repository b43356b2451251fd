// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The range of motion of each joint.
//
// Each bone has a zero direction, a direction into which it bends, and one across, in the rest axes of its parent. Its
// range is a box of angles along these two. At zero the body stands with its arms 45 degrees away from the trunk.

#include <array>

#include "garmentfit/skeleton.h"

namespace garmentfit {

class JointLimits {
public:
    explicit JointLimits(const Rig& rig);

    /// The zero direction of a bone, world: the comfort cost counts from here. `parent_turn` as in PlacedBones.
    Vec3 comfort_direction(int bone, const Eigen::Quaterniond& parent_turn) const
    {
        return parent_turn * ranges_[bone].zero;
    }

    /// The angle by which a direction exceeds the bone's range, rad; 0 within.
    double excess(int bone, const Eigen::Quaterniond& parent_turn, const Vec3& direction) const;

private:
    struct Range {
        Vec3 zero, bend, across;  // unit, rest axes of the parent
        double bend_min, bend_max, across_min, across_max;  // rad
    };
    std::array<Range, bone_count> ranges_;
};

/// [wu_2018_garment_fitting]: an angle of more than 90 degrees between forearm and clavicle folds the arm into the
/// chest.
inline bool folds_into_chest(const Vec3& clavicle, const Vec3& forearm) { return clavicle.dot(forearm) < 0; }

}  // namespace garmentfit
