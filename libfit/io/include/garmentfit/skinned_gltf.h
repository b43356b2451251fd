// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Rigged bodies as skinned glTF, so that other programs can pose them, and rigs made by other programs.

#include <filesystem>

#include "garmentfit/export.h"
#include "garmentfit/skeleton.h"

namespace garmentfit {

/// Writes a GLB: metres, +y up, one mesh, one skin. Joints have the names of Bone and are at the heads of the bones.
/// Head, hands, feet and their tips follow as joints without weight. Never leaves a half-written file.
GARMENTFIT_API void write_skinned_glb(const std::filesystem::path& path, const TriangleMesh& surface, const Rig& rig);

/// Bones and weights of a rig by another program, in the file's units and axes, vertices in the order of MeshFile.
/// Joints are recognised by the names of this library, Mixamo, Unreal, VRM, MakeHuman or SMPL. Weights on fingers and
/// toes go to the bone before them.
struct ForeignRig {
    Skeleton skeleton;
    SkinWeights weights;
};

/// @throws InvalidInput: not glTF, no skin, joints that a human needs have no known names.
GARMENTFIT_API ForeignRig read_skinned_gltf(const std::filesystem::path& path);

}  // namespace garmentfit
