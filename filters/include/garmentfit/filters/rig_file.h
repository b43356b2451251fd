// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// rig.json: the skeleton, and after a fit its poses, in the units and axes of the body's file.

#include <filesystem>
#include <string>
#include <vector>

#include "garmentfit/fit_skeleton.h"
#include "garmentfit/rig_body.h"
#include "garmentfit/skeleton.h"
#include "garmentfit/units.h"

namespace garmentfit {

struct FittedGarment {
    std::string file;
    Frame frame;  ///< of the garment as given
    FitResult fit;  ///< without its scores
};

struct RigFile {
    Frame frame;  ///< of the body
    Rig rig;  ///< where it has no weights, those are in rigged.ply
    std::vector<FittedGarment> garments;

    bool has_weights() const { return rig.weights.weights.rows() > 0; }
};

/// Skeleton and fits, and the weights where the rig has them.
void write_rig_file(const std::filesystem::path& path, const RigFile& contents);
/// Joints given by hand, {"joints": {"lelbow": [x, y, z], ...}}, or those of a whole rig.json; in metres.
/// @throws InvalidInput naming the file and what is wrong in it, or all names of joints.
GivenJoints read_joints(const std::filesystem::path& path, const Frame& frame);
/// @throws InvalidInput naming the file and what is wrong in it.
RigFile read_rig_file(const std::filesystem::path& path);
/// With weights: its own, or those of rigged.ply beside it. @throws InvalidInput.
RigFile read_whole_rig(const std::filesystem::path& path);

}  // namespace garmentfit
