// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// rig.json: the skeleton, and after a fit its poses, in the units and axes of the body's file.

#include <filesystem>
#include <string>
#include <vector>

#include "fit/fit_skeleton.h"
#include "fit/rig_body.h"
#include "fit/skeleton.h"
#include "fit/units.h"

namespace fit::cli {

struct FittedGarment {
    std::string file;
    Frame frame;  ///< of the garment as given
    FitResult fit;  ///< without scores
};

struct RigFile {
    Frame frame;  ///< of the body
    Rig rig;  ///< without weights: those are in rigged.ply
    std::vector<FittedGarment> garments;
};

void write_rig_file(const std::filesystem::path& path, const RigFile& contents);
/// Joints given by hand, {"joints": {"lelbow": [x, y, z], ...}}, or those of a whole rig.json; in metres.
/// @throws InvalidInput naming the file and what is wrong in it, or all names of joints.
GivenJoints read_joints(const std::filesystem::path& path, const Frame& frame);
/// @throws InvalidInput naming the file and what is wrong in it.
RigFile read_rig_file(const std::filesystem::path& path);

}  // namespace fit::cli
