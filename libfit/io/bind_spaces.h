// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

struct aiScene;

namespace garmentfit {

/// Gives other names to nodes of meshes that are called as a joint is: Assimp finds joints by name, and took a mesh "Arm"
/// for the joint "Arm" that moves it.
void rename_meshes_called_as_joints(aiScene& scene);

/// Shows skinned meshes where their nodes are whose bind matrices put them far from their joints: some exporters
/// (Blender's of COLLADA) leave the turn and scale of an armature out of them, so that a body lies, or is 100 times as
/// large as its skeleton.
void restore_bind_shapes(aiScene& scene);

/// Brings the skinned meshes of a scene into one space, so that each joint has the same bind matrix for all of them.
/// FBX and COLLADA have one for each mesh and joint; Assimp's exporter of glTF writes only one for each joint, that of
/// the first mesh, and shows the others elsewhere.
void unify_bind_spaces(aiScene& scene);

}  // namespace garmentfit
