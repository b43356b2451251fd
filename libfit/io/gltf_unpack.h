// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Packed glTF as plain glTF: EXT_meshopt_compression, KHR_draco_mesh_compression, KHR_mesh_quantization, sparse
// accessors and instances, and FBX and COLLADA (scene_file.h). What reads or writes the result need not know of them.

#include <filesystem>

#include "gltf_container.h"

namespace garmentfit {

/// The container as it is where nothing is packed or shown twice; else one with a single buffer in which all geometry
/// stands as the core of glTF 2.0 has it, vertices in their order. A mesh that several nodes show is copied, so that
/// each shows its own vertices. Other members of the file keep their indices.
/// @param folder  of buffers beside the file
/// @throws InvalidInput: as read_gltf_container; packed data that are mangled, or have more than 2 GB once unpacked
GltfContainer read_plain_gltf(const FileBytes& file, const std::filesystem::path& folder);

}  // namespace garmentfit
