// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Brings a dressed body from one pose to another, cloth along, contact kept.
//
// Method   slerp of every joint [wu_2018_garment_fitting, step 5]; the cloth is carried by the body's own skinning as a
//          prediction, cut to its intersection-free part, and relaxed.
// Units, cost and promise as in drape_garment.h.

#include <vector>

#include "garmentfit/drape_garment.h"

namespace garmentfit {

struct RecoverOptions {
    ClothOptions cloth;
    int largest_steps = 200;  ///< give up after this many
    double step_length = 0.015;  ///< m; nothing under cloth moves further in a step, as far as largest_steps permits
    int settling_steps = 60;  ///< time steps under gravity, at the end
    int frames
        = 0;  ///< states on the way to hand out, evenly spread, both ends included; 1: the end alone; 0: none. There are
    ///< as many steps at least as ways between them
};

/// A state on the way, in which nothing crosses either.
struct RecoverFrame {
    double share;  ///< of the way, 0 = the pose `from`, 1 = the pose `to` with the cloth settled
    Positions body;
    std::vector<Positions> garments;  ///< from the inside out
};

/// Two parts of a body that enter each other in the pose `to`, where cloth is near: it has no place between them, and is not certified
/// if it has to be there.
struct Overlap {
    std::string part, other;  ///< as in TooTight
    double depth;  ///< m; the deepest vertex of the one in the other
};

/// The dressed body at the pose reached. In the pose of the input (Pose()) its vertices equal BodyMesh::surface bit for bit.
struct RecoverResult : DressedBody {
    std::vector<TooTight> too_tight;  ///< in the pose `to`, worst first
    std::vector<HeldBack>
        held_back;  ///< where cloth had no room, in the pose `to` or where the body got stuck; worst first
    std::vector<Overlap>
        overlaps;  ///< why it had none, if it is the body; deepest first; looked for only if not certified
    std::vector<RecoverFrame>
        frames;  ///< those that are certified, up to where the body got stuck; memory 24 bytes per vertex and frame
    double pose_reached
        = 0;  ///< 1 = the whole way was gone, though parts may be held back; where the body got stuck, with some
    ///< part more than 8 cm behind, the last share of the way at which all of it was in place:
    ///< it is left there
    double speed = 0;  ///< m/s, of the fastest vertex of the cloth at the end; settled below k_at_rest
    bool certified = false;  ///< arrived, nothing too tight, every certificate clean
    ClothSeconds seconds;
};

/// Moves a dressed body to another pose.
/// @param start   what draping returned, say. Parts that cloth holds back from the pose at the start move to their places on the way, and
///                hands that were stretched out are bent back on the way to the pose of the input.
/// @param target  Pose() is the pose of the input
/// @throws InvalidInput when the garments cross the body at the start. Cancelled.
GARMENTFIT_API RecoverResult recover_pose(const Rig& rig, const BodyMesh& body, const DressedBody& start,
                                          const Pose& target, const RecoverOptions& options = {},
                                          const Progress& progress = {});

}  // namespace garmentfit
