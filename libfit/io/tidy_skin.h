// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What is wrong in the file of an avatar and would be wrong in its outfit, too.

#include "garmentfit/garment_weights.h"
#include "gltf_container.h"
#include "gltf_skin.h"

namespace garmentfit {

/// Pictures that are in the JSON as text. Viewers show them there, but a GLB is to have them in its buffer.
void move_pictures_into_buffer(GltfContainer& container);

/// Skinned meshes stand at the root of their scene, without transforms: glTF has programs ignore those of their nodes and
/// of the nodes above (glTF 2.0, sec. 3.7.3.3), and not all do. Nodes keep their numbers; one with children stays.
void free_skinned_meshes(nlohmann::ordered_json& json);

/// Meshes of which a vertex has weights that the format does not allow (a sum other than 1, a joint twice, negative
/// ones, none) or joints in slots without weight get other values in the accessors of joints and weights. Other meshes
/// keep theirs, bit for bit.
/// @param model, skin  of the file as it was read
/// @param weights  of `skin`, rows that sum to 1
void tidy_weights(GltfContainer& container, const FileBytes& file, const tinygltf::Model& model, const FileSkin& skin,
                  const JointWeights& weights);

}  // namespace garmentfit
