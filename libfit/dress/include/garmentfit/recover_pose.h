// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Moves a dressed body from one pose to another. Cloth and body never cross.
//
// Method   slerp of every joint [wu_2018_garment_fitting, step 5]. The body's own skinning advects the cloth as a
//          prediction, which is cut to its intersection-free part; then the cloth finds its rest.
// Units, cost and promise as in drape_garment.h.

#include <optional>
#include <string_view>
#include <vector>

#include "garmentfit/drape_garment.h"

namespace garmentfit {

/// How far cloth is led at the end. `standard`: until the forces on it balance. `draft`: it only hangs for the settling
/// steps, in a fraction of the time; it is certified as well, but would go on to slide.
enum class Quality { standard, draft };
/// "standard", "draft".
GARMENTFIT_API const std::vector<std::string_view>& quality_names();

/// m; RecoverOptions::press at most. fitted: guess; flesh of half a thigh gives way no further.
constexpr double k_largest_press = 0.1;

/// Defaults are fitted: guesses on the pairs that dress/tuning.h names.
struct RecoverOptions {
    ClothOptions cloth;
    int largest_steps = 200;  ///< no more steps along the path than these; they get longer instead
    double step_length = 0.015;  ///< m; nothing under cloth moves further in a step, as far as largest_steps permits
    int settling_steps = 20;  ///< time steps under gravity, once the target is reached
    Quality quality = Quality::standard;  ///< where skin is held back further than `press`, always a draft
    double settle_time = 0;  ///< s, of simulated time to go on for after rest
    /// m; skin that cloth holds back from its place in the target pose, by no more than this, stays pressed in, and the
    /// cloth is certified and led to rest on it. 0: all skin has to be in its place.
    double press = 0;
    /// States along the path to return, evenly spread, both ends included; 1: the end alone; 0: none. A frame is where
    /// a step ends, so there are at least frames - 1 steps.
    int frames = 0;
    bool only_rests = false;  ///< a body that is in the target pose already makes no steps to it
};

/// A state along the path, in which nothing crosses either.
struct RecoverFrame {
    double share;  ///< of the path: 0 = the pose at the start, 1 = the target with the cloth settled
    Positions body;
    std::vector<Positions> garments;  ///< from the inside out
};

/// Two parts of a body that enter each other in the target pose, near cloth. Cloth has no place between them: where it
/// has to be there, the result is not certified.
struct Overlap {
    std::string part, other;  ///< as in TooTight
    double depth;  ///< m; of the deepest vertex of the one in the other
};

/// The dressed body at the pose reached. In the pose of the input (Pose()) its vertices equal BodyMesh::surface bit for
/// bit, but for what is held back.
struct RecoverResult : DressedBody {
    std::vector<TooTight> too_tight;  ///< in the target pose, worst first
    std::vector<HeldBack> held_back;  ///< in the target pose, or where the body got stuck; worst first
    std::vector<Overlap> overlaps;  ///< deepest first; looked for only if the result is not certified
    std::vector<RecoverFrame> frames;  ///< those that are certified; memory 24 bytes per vertex and frame
    /// Share of the path. 1: the target was reached, though parts may be held back. Less: the body got stuck, with some
    /// part more than 8 cm behind, or time ran out, and it was put back to the last share at which all of it was in
    /// place.
    double pose_reached = 0;
    double speed = 0;  ///< m/s, of the fastest vertex of the cloth in the last settling step
    /// At the end. Without friction where the quality is a draft; none where time ran out before.
    std::optional<ForceResidual> residual;
    /// Target reached, with no skin held back further than RecoverOptions::press permits; nothing too tight, every
    /// certificate clean.
    bool certified = false;
    bool out_of_time = false;  ///< the deadline of the Progress passed, on the path or before the cloth was settled
    ClothSeconds seconds;
};

/// Moves a dressed body to another pose.
/// @param dressed  what drape_garment returned, say. Parts that cloth holds back at the start move to their places
///                 along the path. Hands that were stretched out are bent back on the path to the pose of the input.
/// @param target   Pose() is the pose of the input
/// @throws InvalidInput when the garments cross the body at the start. Cancelled.
GARMENTFIT_API RecoverResult recover_pose(const Rig& rig, const BodyMesh& body, const DressedBody& dressed,
                                          const Pose& target, const RecoverOptions& options = {},
                                          const Progress& progress = {});

}  // namespace garmentfit
