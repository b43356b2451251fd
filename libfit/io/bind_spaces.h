// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

struct aiScene;

namespace garmentfit {

/// Brings the skinned meshes of a scene into one space, so that each joint has the same bind matrix for all of them.
/// FBX and COLLADA have one for each mesh and joint; Assimp's exporter of glTF writes only one for each joint, that of
/// the first mesh, and shows the others elsewhere.
void unify_bind_spaces(aiScene& scene);

}  // namespace garmentfit
