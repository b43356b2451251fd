// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Rigged bodies as skinned glTF, so that other programs can pose them, and rigs made by other programs.

#include <filesystem>

#include "garmentfit/export.h"
#include "garmentfit/skeleton.h"

namespace garmentfit {

/// Writes a GLB: metres, +y up, one mesh, one skin. Its joints are called as in Bone and stand at the heads of the bones; head,
/// hands, feet and their tips follow as joints that carry no weight. Never leaves a half-written file.
GARMENTFIT_API void write_skinned_glb(const std::filesystem::path& path, const TriangleMesh& surface, const Rig& rig);

/// Bones and weights of another's rig, in the file's units and axes, vertices in the order of MeshFile. Joints go by
/// the names in use: ours, Mixamo's, Unreal's, VRM's, MakeHuman's, SMPL's; what hangs on fingers and toes goes to the bone before.
struct ForeignRig {
    Skeleton skeleton;
    SkinWeights weights;
};

/// @throws InvalidInput: not glTF, no skin, joints that a human needs have no known names.
GARMENTFIT_API ForeignRig read_skinned_gltf(const std::filesystem::path& path);

}  // namespace garmentfit
