// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Moving meshes as one glTF file that other programs can play.

#include <filesystem>
#include <string>
#include <vector>

#include "garmentfit/export.h"
#include "garmentfit/types.h"

namespace garmentfit {

/// A mesh that keeps its faces while its vertices move.
struct MovingMesh {
    std::string name;
    Triangles triangles;
    std::vector<Positions> frames;  ///< at least one, n x 3 each, metres, +y up
    Eigen::RowVector3d colour = Eigen::RowVector3d::Constant(0.7);  ///< linear RGB, 0..1
};

/// Writes a GLB. Each frame is a morph target; players blend frames that are `seconds_per_frame` apart. All meshes have
/// the same number of frames. Never leaves a half-written file. Size 12 bytes per vertex and frame.
/// @throws InvalidInput when the numbers of frames differ or the place cannot be written.
GARMENTFIT_API void write_animated_glb(const std::filesystem::path& path, const std::vector<MovingMesh>& meshes,
                                       double seconds_per_frame);

}  // namespace garmentfit
