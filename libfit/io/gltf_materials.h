// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// UVs, materials and pictures of glTF. Only sources that read glTF include it.

#include <vector>

#include <nlohmann/json.hpp>

#include "garmentfit/appearance.h"
#include "gltf_model.h"

namespace garmentfit {

/// A primitive whose faces are part of the mesh, in the order of the faces.
struct GltfPart {
    const tinygltf::Primitive* primitive;
    Eigen::Index first_row;  ///< of its vertices in the mesh
    Eigen::Index triangles;
};

/// @param json       of the file, its pictures embedded
/// @param triangles  of all parts
/// @param warnings   of pictures that are missing or too large, whether or not somebody wants the appearance
/// What is mangled becomes a warning: the geometry does not need it.
Appearance gltf_appearance(const FileBytes& file, const tinygltf::Model& model, const nlohmann::ordered_json& json,
                           const std::vector<GltfPart>& parts, const Triangles& triangles,
                           std::vector<std::string>& warnings);

}  // namespace garmentfit
