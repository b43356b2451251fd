// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

struct aiScene;

namespace garmentfit {

/// Puts the meshes of an FBX file where their geometric transforms put them, which move a node's mesh and none of its
/// children. Where Assimp joins the pivots of a node, as it must to keep animations, it multiplies the inverse into the
/// node itself, and it leaves bind matrices without: a skinned mesh lies beside its skeleton.
/// @param exact  the same file, read with its pivots
void apply_geometric_transforms(const aiScene& exact, aiScene& scene);

}  // namespace garmentfit
