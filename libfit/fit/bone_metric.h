// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How well bones run through a garment: the skeleton-based error metric, per bone.

#include <array>
#include <vector>

#include "clearance_field.h"
#include "error_metric.h"
#include "garmentfit/skeleton.h"

namespace garmentfit {

/// Who takes part, and how thick the limbs are.
struct Figure {
    std::array<bool, bone_count> covered {};
    std::array<bool, bone_count> worn_elsewhere {};  // in another of several garments
    std::array<double, bone_count> radii {};  // m
    std::array<double, extremity_count> tip_radii {};  // m
};

/// @param covered  as the garment's type says
Figure figure_of(const Rig& rig, const std::vector<Bone>& covered);

class BoneMetric {
public:
    BoneMetric(const ClearanceField& cloth, const Figure& figure) : cloth_(cloth), figure_(figure) { }

    /// E_B of a covered bone, m: the room at its five samples, as far as the limb needs it.
    double worn(int bone, const Vec3& head, const Vec3& tail) const;
    /// Of that, what the limb cannot do without, m.
    double needed(int bone, const Vec3& head, const Vec3& tail) const;
    /// As a share of all that it needs, 0 to 1; 0 for bones that are not covered.
    std::array<double, bone_count> clearance_shares(const Skeleton& joints) const;
    /// What an arm or leg that the garment does not cover lacks of room to the cloth, m, <= 0; arms also keep out of the
    /// garment. 0 for other bones.
    double bare(int bone, const Vec3& head, const Vec3& tail) const;
    /// The same for what lies beyond the last joint.
    double bare_tip(Extremity extremity, const Vec3& joint, const Vec3& tip) const;

    /// How deep a forearm is inside its own trunk, m: a shirt's body has room for it, but the trunk is there already.
    double overlap(int bone, const Vec3& head, const Vec3& tail, const Skeleton& joints) const;

    /// How many of the five samples are inside, by the cloth itself.
    int samples_inside(const Vec3& head, const Vec3& tail) const;

    /// No place is worth more to a bone than that, m.
    double most(int bone) const { return figure_.covered[bone] ? k_samples * max_clearance_value(figure_.radii[bone]) : 0; }

    const ClearanceField& cloth() const { return cloth_; }
    const Figure& figure() const { return figure_; }
    double value(int bone, const Vec3& head, const Vec3& tail) const
    {
        return figure_.covered[bone] ? worn(bone, head, tail) : bare(bone, head, tail);
    }

private:
    const ClearanceField& cloth_;
    Figure figure_;
};

}  // namespace garmentfit
