// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The search for the posture in which the bones run best through a garment: the energy, and the moves that raise it.

#include <array>
#include <limits>
#include <vector>

#include "bone_metric.h"
#include "type_guess.h"
#include "joint_limits.h"
#include "posture.h"
#include "clearance_search.h"

namespace garmentfit {

/// Two bones that are searched as one chain, and what lies beyond them.
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

/// How far and how finely a move looks. Grids are sorted by distance from the present: of equals, the nearest wins.
struct Reach {
    double extent, spacing;  // metres or radians
    int beam = 6;  // chains of bones that are kept after their first bone
    bool exact = true;  // no bone may pass through cloth (slower)
};

using CoverDistances = Eigen::ArrayXf;  // m, from points on the cloth to the nearest worn limb, or to one bone

/// What a posture's energy is made of.
struct EnergyParts {
    PlacedBones bones;
    std::array<double, bone_count> by_bone {};  // m
    std::array<double, extremity_count> by_tip {};  // m
    std::array<CoverDistances, bone_count> cover;  // of worn bones
    double energy = 0;  // m
};

class SkeletonSearch {
public:
    /// Keeps references: the rig, the limits and the metric have to live as long.
    SkeletonSearch(const Rig& rig, const JointLimits& limits, const BoneMetric& metric, const GarmentCues& cues);

    /// E of equation (4) and what it leaves open: bare limbs keep away from cloth, poses are human, the garment hangs from
    /// the body, none of it is left empty. Metres, to be maximised. Crossings are counted apart.
    double energy(const Posture& posture) const { return parts(posture).energy; }
    /// The same to the last bit, given the parts of a posture that may differ in a few bones only: what did not move is not asked again.
    double energy(const Posture& posture, const EnergyParts& near) const;
    EnergyParts parts(const Posture& posture) const;
    /// For bones and extremities that pass through cloth: more than any room can repay, but for hands and
    /// feet, which may find none.
    double crossing_cost(const Posture& posture) const;
    double crossing_cost(const Posture& posture, const Limb& limb) const;
    double stuck_cost(const Posture& posture) const;  ///< of hands and feet alone
    int bones_through_cloth(const Posture& posture) const;
    /// E_B of equation (1) of each covered bone, m; 0 for the others.
    std::array<double, bone_count> scores(const Posture& posture) const;

    /// The body at ease, turned by `turn`, its root at `root`.
    Posture at_ease(const Vec3& root, const Eigen::Quaterniond& turn) const;

    /// What a metre of height is worth: a shirt hangs from the shoulders, trousers are pulled up. m/m.
    double sag() const;

    /// Energy less the cost of crossings.
    double total(const Posture& posture) const { return energy(posture) - crossing_cost(posture); }

    /// Where the trunk has the most room as this posture holds and turns it; its root counts for nothing.
    std::vector<Place> trunk_places(const MinMaxPyramid& clearance, const Posture& posture, double spacing, double apart,
                                    std::size_t count) const;

    /// The best chain of the limb's two bones; the present posture when all of them pass through cloth.
    Posture limb_moved(const Posture& present, const Limb& limb, const Reach& reach) const;

    /// Turned about the middle of the trunk.
    Posture turned(const Posture& present, const Vec3& rotation_vector) const;

    /// The limb as the other of its pair is held, better or not.
    Posture mirrored(const Posture& present, const Limb& limb) const;

    const BoneMetric& metric() const { return metric_; }
    const GarmentCues& cues() const { return cues_; }
    const Skeleton& own() const { return rig_.skeleton; }

private:
    struct Chain;
    static constexpr double k_any = -std::numeric_limits<double>::infinity();

    double crossing_cost(const PlacedBones& bones, Extremity extremity) const;
    double bone_energy(int bone, const Vec3& head, const Vec3& tail, const Eigen::Quaterniond& parent_turn,
                       const Skeleton& joints, double least = k_any) const;
    double posture_cost(int bone, const Vec3& direction, const Eigen::Quaterniond& parent_turn) const;
    double cuff_cost(int bone, const Vec3& tail, const Skeleton& joints) const;
    double twin_cost(int bone, const Vec3& direction, const Skeleton& joints) const;
    double stance_energy(const Posture& posture) const;
    CoverDistances cover_distances(const PlacedBones& bones, const Limb& without) const;
    double emptiness(const CoverDistances& distances) const;
    CoverDistances cover_distances(int bone, const Vec3& head, const Vec3& tail) const;
    template <class BoneEnergy, class TipEnergy, class Lower>
    double sum_of(const Posture& posture, const BoneEnergy& by_bone, const TipEnergy& by_tip, const Lower& lower) const;
    double tip_energy(const PlacedBones& bones, int extremity) const;
    Slab between_legs() const;
    bool fills_tube(const Limb& limb) const;
    std::vector<Chain> extended(const Chain& chain, const Limb& limb, int link, const Vec3& start,
                                const Skeleton& joints, const Reach& reach, double least) const;
    double tip_energy(const Limb& limb, const Chain& chain) const;
    Vec3 tip_of(const Limb& limb, const Chain& chain) const;

    const Rig& rig_;
    const JointLimits& limits_;
    const BoneMetric& metric_;
    Eigen::ArrayX3f cover_;  // points spread over the garment
    GarmentCues cues_;
    bool hangs_from_shoulders_;
};

}  // namespace garmentfit
