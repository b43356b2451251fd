// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The container of glTF: JSON text, the chunks of GLB, data URIs. gltf_file.cpp reads what the JSON means.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "file_bytes.h"

namespace garmentfit {

/// Type of the chunk of a GLB that holds its buffer: "BIN".
inline constexpr std::uint32_t k_binary_type = 0x004E4942;

struct GltfChunk {
    std::uint32_t type = 0;
    std::string bytes;
};

struct GltfContainer {
    bool is_binary = false;
    nlohmann::ordered_json json;  ///< keeps the order of its members
    bool is_indented = false;  ///< the JSON of a .gltf spreads over lines
    std::vector<GltfChunk> chunks;  ///< of GLB, after the JSON; the first may be the binary buffer

    /// The buffer that lives in the file itself; null when there is none.
    std::string* own_buffer();
};

/// @throws InvalidInput: truncated, mangled, not version 2, not JSON, or JSON nested too deeply.
GltfContainer read_gltf_container(const FileBytes& file);

std::string bytes_of(const GltfContainer& container);

/// Makes all views refer to a single buffer. @return its bytes, which the caller stores
/// @throws InvalidInput: a view of a buffer that there is not
std::string merge_buffers(const FileBytes& file, nlohmann::ordered_json& json, const std::vector<std::string>& buffers);

/// Copies pictures from beside the file into it, so that it can be written to another folder.
/// Those that are missing stay as they are.
void embed_pictures(nlohmann::ordered_json& json, const std::filesystem::path& folder);

/// The file that an image names beside the glTF; empty where the image is in the file.
std::string file_of_picture(const nlohmann::ordered_json& image);

/// In place of pictures that are still beside the file: one pixel that changes nothing where a material shows it.
void fill_missing_pictures(nlohmann::ordered_json& json);

}  // namespace garmentfit
