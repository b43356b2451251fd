// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How well single bones run through a garment: the skeleton-based error metric by clearance.

#include <array>

#include "bone_samples.h"
#include "clearance_field.h"
#include "limbs.h"
#include "tuning.h"

namespace garmentfit {

class BoneMetric {
public:
    /// Keeps a reference to the cloth.
    BoneMetric(const ClearanceField& cloth, const LimbRadii& limbs, const EnergyWeights& weights = k_energy_weights) :
        cloth_(cloth), limbs_(limbs), weights_(weights)
    {
    }

    bool covers(int bone) const { return limbs_.covered[bone]; }

    /// E_B: covered_value or uncovered_value, m.
    double value(int bone, const Vec3& head, const Vec3& tail) const
    {
        return covers(bone) ? covered_value(bone, head, tail) : uncovered_value(bone, head, tail);
    }
    /// No place has a greater value, m.
    double max_value(int bone) const { return covers(bone) ? k_samples * max_clearance_value(limbs_.radii[bone]) : 0; }

    /// The sum of clearance_value over the samples, m.
    double covered_value(int bone, const Vec3& head, const Vec3& tail) const;
    /// The sum over the samples of the clearance up to the limb's radius, m.
    double needed_clearance(int bone, const Vec3& head, const Vec3& tail) const;
    /// needed_clearance as a share of its maximum, 0 to 1; 0 for uncovered bones.
    std::array<double, bone_count> clearance_shares(const Skeleton& joints) const;

    /// The clearance that an uncovered arm or leg lacks, m, <= 0. Arms also keep out of the garment. 0 for other bones.
    double uncovered_value(int bone, const Vec3& head, const Vec3& tail) const;
    /// The same for an extremity, from the last joint to the tip.
    double uncovered_tip_value(Extremity extremity, const Vec3& joint, const Vec3& tip) const;

    /// How deep a forearm is inside the body's own trunk, m: a wide shirt has clearance there, but the trunk fills it.
    double trunk_overlap(int bone, const Vec3& head, const Vec3& tail, const Skeleton& joints) const;

    /// How many of the five samples are inside the garment.
    int samples_inside(const Vec3& head, const Vec3& tail) const;

    const ClearanceField& cloth() const { return cloth_; }
    const LimbRadii& limbs() const { return limbs_; }
    const EnergyWeights& weights() const { return weights_; }

private:
    const ClearanceField& cloth_;
    LimbRadii limbs_;
    EnergyWeights weights_;
};

}  // namespace garmentfit
