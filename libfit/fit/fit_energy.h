// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The energy of a posture in a garment, in metres, to be maximised. docs/fit.md lists its terms, tuning.h their
// weights.

#include <array>
#include <limits>

#include "bone_metric.h"
#include "joint_limits.h"
#include "posture.h"
#include "type_guess.h"

namespace garmentfit {

/// m, from points on the cloth to the skin of one covered limb, or of the nearest one.
using CoverageDistances = Eigen::ArrayXf;

/// The energy of a posture, term by term.
struct EnergyTerms {
    PlacedBones bones;
    std::array<double, bone_count> by_bone {};  // m
    std::array<double, extremity_count> by_tip {};  // m
    std::array<CoverageDistances, bone_count> coverage;  // of covered bones
    double energy = 0;  // m
};

class FitEnergy {
public:
    static constexpr double k_any = -std::numeric_limits<double>::infinity();  // unit: a bound that everything exceeds

    /// Keeps references: rig, limits and metric have to live as long.
    /// @param bone_thickness  m; a bone that passes cloth this closely counts as passing through it
    FitEnergy(const Rig& rig, const JointLimits& limits, const BoneMetric& metric, const GarmentCues& cues,
              double bone_thickness = 0);

    EnergyTerms evaluate(const Posture& posture) const;
    /// Without the cost of crossings, m.
    double value(const Posture& posture) const { return evaluate(posture).energy; }
    /// The same bits, given the terms of a posture that may differ in a few bones: only terms that changed are
    /// evaluated.
    double value(const Posture& posture, const EnergyTerms& near) const;
    /// Less the cost of crossings, m.
    double total(const Posture& posture) const { return value(posture) - crossing_cost(posture); }

    /// Cost of all bones and extremities that pass through cloth, and of arms that miss their sleeves, m.
    double crossing_cost(const Posture& posture) const;
    double crossing_cost(const Posture& posture, const Limb& limb) const;
    /// Of hands and feet alone.
    double tip_crossing_cost(const Posture& posture) const;
    int bones_through_cloth(const Posture& posture) const;
    bool passes_through_cloth(const Vec3& from, const Vec3& to) const;
    /// Of a covered arm with its elbow there: no cloth divides it from the spine, so it is not in a sleeve. In a poncho
    /// that is so of all arms. False for other bones, and for arms that the garment does not cover.
    bool misses_sleeve(int bone, const Vec3& elbow, const Skeleton& joints) const;

    /// E_B of each covered bone, m; 0 for the others.
    std::array<double, bone_count> bone_scores(const Posture& posture) const;
    /// The sum of E_B as a share of the clearance that the covered bones need, 0 to about 1. Tight clothes have 0.6 and
    /// more.
    double clearance_share(const Posture& posture) const;

    /// Terms of one bone that hangs on a bone turned by `parent_turn`, m. k_any where the costs alone show that it
    /// cannot exceed `least`: angles cost less time than clearance.
    double bone_value(int bone, const Vec3& head, const Vec3& tail, const Eigen::Quaterniond& parent_turn,
                      const Skeleton& joints, double least = k_any) const;
    double tip_value(int extremity, const PlacedBones& bones) const;
    CoverageDistances coverage_distances(int bone, const Vec3& head, const Vec3& tail) const;
    /// Of all covered bones but the limb's.
    CoverageDistances coverage_distances(const PlacedBones& bones, const Limb& without) const;
    double coverage_cost(const CoverageDistances& distances) const
    {
        return weights_.coverage * double(distances.mean());
    }

    /// Of the cloth from the nearest covered limb, m; larger distances than the cutoff count as that.
    double mean_coverage_distance(const Posture& posture) const;

    /// The value of a metre of height of the root, m/m: positive for garments that hang from the shoulders, negative
    /// for those that are pulled up. A strapless bodice does neither: it sits where it is as wide as the chest.
    double hang_slope() const
    {
        return hangs_from_shoulders_ ? weights_.hang : metric_.covers(thorax) ? 0 : -weights_.hang;
    }
    bool hangs_from_shoulders() const { return hangs_from_shoulders_; }

    const BoneMetric& metric() const { return metric_; }
    const GarmentCues& cues() const { return cues_; }
    const Rig& rig() const { return rig_; }
    const Skeleton& rest() const { return rig_.skeleton; }
    const JointLimits& limits() const { return limits_; }
    const EnergyWeights& weights() const { return weights_; }

private:
    double tip_crossing_cost(const PlacedBones& bones, Extremity extremity) const;
    double posture_cost(int bone, const Vec3& direction, const Eigen::Quaterniond& parent_turn) const;
    double symmetry_cost(int bone, const Vec3& direction, const Skeleton& joints) const;
    double cuff_cost(int bone, const Vec3& tail, const Skeleton& joints) const;
    double armhole_cost(int bone, const Vec3& tail, const Skeleton& joints) const;
    double facing_cost(const Posture& posture) const;
    double stance_value(const Posture& posture) const;
    template <class BoneValue, class TipValue, class Lower>
    double sum_terms(const Posture& posture, const BoneValue& by_bone, const TipValue& by_tip,
                     const Lower& lower) const;

    const Rig& rig_;
    const JointLimits& limits_;
    const BoneMetric& metric_;
    const EnergyWeights& weights_;
    Eigen::ArrayX3f coverage_points_;  // m, spread over the garment
    GarmentCues cues_;
    bool hangs_from_shoulders_;
    double bone_thickness_;  // m
    double lowest_root_, highest_root_;  // m, y: beyond the cloth the root gains nothing, or it would move on for ever
};

}  // namespace garmentfit
