// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// All ways in which a garment may be worn, with the probability of each.

#include <memory>
#include <vector>

#include "clearance_field.h"
#include "evidence.h"
#include "garmentfit/fit_skeleton.h"
#include "garmentfit/progress.h"
#include "joint_limits.h"

namespace garmentfit {

/// A garment as it is held, and what is measured of it there.
struct HeldGarment {
    Eigen::Quaterniond turn;  ///< from the garment as it was given
    double upright = 0, askew = 0;  ///< WayUp::evidence and askew
    TriangleMesh outward;
    std::vector<Opening> openings;
    GarmentCues cues;
    std::unique_ptr<const ClearanceField> clearance;
};

/// A held garment with the bones that it may cover, and the energy of postures there.
class Attempt {
public:
    Attempt(const Rig& rig, std::shared_ptr<const HeldGarment> garment, const Coverage& coverage);
    Attempt(const Attempt&) = delete;
    Attempt& operator=(const Attempt&) = delete;

    const Rig& rig() const { return rig_; }
    const HeldGarment& garment() const { return *garment_; }
    const Coverage& coverage() const { return coverage_; }
    const JointLimits& limits() const { return limits_; }
    const GarmentCues& cues() const { return garment_->cues; }
    const FitEnergy& energy() const { return energy_; }

private:
    const Rig& rig_;
    std::shared_ptr<const HeldGarment> garment_;
    Coverage coverage_;
    JointLimits limits_;
    BoneMetric metric_;
    FitEnergy energy_;
};

struct Hypothesis {
    std::shared_ptr<const Attempt> attempt;
    Wearing wearing;
    /// Those of rank 0 sum to 1. The others, which face alike, have that of their rank 0: they stand in for it.
    double probability = 0;

    Vec3 up() const { return attempt->garment().turn.conjugate() * Vec3::UnitY(); }
    /// Half of the covered bones are inside, with some clearance, and at most so many pass through cloth; in place, any
    /// may.
    bool is_possible(int max_crossing) const;
    /// With a number by the probability: on the most probable ways the refinement is worth its time.
    bool is_possible() const;
};

/// Whether one stands in for the other: the same garment, held alike, on the same bones, and facing alike.
bool is_same_way(const Hypothesis& a, const Hypothesis& b);

/// The most probable first. @param options  type, front and as_placed leave only the hypotheses that agree with them
/// @throws InvalidInput when there are too few openings for a body, and no type is given.
/// @param body  with the vertices of the rig's weights; without vertices, no garment is taken to lie round it
std::vector<Hypothesis> find_hypotheses(const Rig& rig, const TriangleMesh& body, const TriangleMesh& outward,
                                        const FitOptions& options, const Progress& progress);

/// The covered bones that have at least so many of their five samples inside.
std::vector<Bone> bones_inside(const FitEnergy& energy, const Posture& posture, int samples);

}  // namespace garmentfit
