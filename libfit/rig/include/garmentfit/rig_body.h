// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Finds the skeleton of a body and how the skin hangs on it.
//
// Method   curve skeleton by mean curvature flow [tagliasacchi_2012_skeletons] on a decimated proxy, its five ends
//          labelled head, hands and feet, joints along its limbs; heat weights [baran_2007_pinocchio] kept to each
//          limb's own stretch of the surface.
// Units    metres, +y up.
// Cost     about linear in the proxy (5 to 15 thousand vertices); the user's vertices only take part in the transfer.
// Promise  all joints lie inside the closed surface; turning or mirroring the body turns or mirrors the rig.

#include <array>
#include <optional>

#include "garmentfit/mesh.h"
#include "garmentfit/progress.h"
#include "garmentfit/skeleton.h"

namespace garmentfit {

/// Joints that the user knows better than the program, m; all, some or none.
struct GivenJoints {
    std::optional<Vec3> root;
    std::array<std::optional<Vec3>, bone_count> tails;
    std::array<std::optional<Vec3>, extremity_count> tips;

    /// Root and tails are all there: nothing needs to be found.
    GARMENTFIT_API bool complete() const;
};

struct RigOptions {
    int proxy_vertices = 8000;  ///< the skeleton is read from a surface decimated to about this many vertices
    bool swap_sides = false;  ///< exchange left and right where the vote is known to be wrong
    std::optional<Vec3> front {};  ///< where the chest faces, roughly, where the user knows; then nothing is voted on
    GivenJoints joints {};  ///< corrections; joints between them adapt
};

/// @throws InvalidInput naming the gate that failed, with numbers, where the mesh is not a human body. Cancelled.
GARMENTFIT_API Rig rig_body(const BodyMesh& body, const RigOptions& options = {}, const Progress& progress = {});

}  // namespace garmentfit
