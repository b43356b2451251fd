// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Things added to the file of another program, which stays as it is otherwise.

#include "glb_model.h"
#include "gltf_container.h"
#include "gltf_scene.h"

namespace garmentfit {

inline std::size_t count_of(const nlohmann::ordered_json& json, const char* list)
{
    return json.contains(list) ? json[list].size() : 0;
}

/// Appends buffer, accessors, materials, pictures and meshes. @pre Both are GLB with a buffer of their own.
void append_model(GltfContainer& container, GltfContainer added);

/// Adds an accessor with values of its own. @return its index
template <class Number, class Matrix>
std::size_t add_accessor(GltfContainer& container, const Matrix& values, int type, int target)
{
    GlbModel glb;
    glb.add<Number>(values, type, target);
    append_model(container, read_gltf_container({ "added", glb.file() }));
    return count_of(container.json, "accessors") - 1;
}

/// A surface in the JSON of its file.
nlohmann::ordered_json& primitive_in(nlohmann::ordered_json& json, const tinygltf::Model& model,
                                     const GltfSurface& surface);

}  // namespace garmentfit
