// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A skinned mesh on its way into a GLB.

#include "garmentfit/skinned_gltf.h"
#include "glb_model.h"
#include "joint_tree.h"

namespace garmentfit {

/// Adds attributes, materials and triangles to the model; the mesh itself is the caller's to add.
/// @param weights  rows of the joints of its skin, instead of `mesh.weights`
tinygltf::Mesh gltf_mesh(const SkinnedMesh& mesh, const FileWeights& weights, GlbModel& glb);

}  // namespace garmentfit
