// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// From the container to a glTF model with checked indices. Private: only sources that read glTF include it.

#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

#include "garmentfit/types.h"
#include "gltf_container.h"
#include "tinygltf.h"

namespace garmentfit {

/// The first line of a text, cut at 200 bytes, for messages.
std::string first_line(const std::string& text);

tinygltf::Model load_model(const FileBytes& file, const GltfContainer& container, const std::filesystem::path& folder);

template <class Item>
const Item& checked(const FileBytes& file, const std::vector<Item>& items, int index, const char* what)
{
    if (index < 0 || static_cast<std::size_t>(index) >= items.size())
        file.fail("refers to " + std::string(what) + " " + std::to_string(index) + ", but there are "
                  + std::to_string(items.size()) + ", counted from 0; export the file again");
    return items[index];
}

/// Where the values of an accessor are.
struct Column {
    int accessor = -1;
    int buffer = 0;
    std::size_t begin = 0, stride = 0, count = 0;

    std::size_t offset(Eigen::Index row) const { return begin + static_cast<std::size_t>(row) * stride; }
    auto place() const { return std::tie(buffer, begin, stride, count); }
};

/// @throws InvalidInput: no such accessor, or beyond its buffer.
Column column_of(const FileBytes& file, const tinygltf::Model& model, int index, const char* what);
/// The same, and made of three floats.
Column vector_column(const FileBytes& file, const tinygltf::Model& model, int index, const char* what);

/// One component of an element; normalised integers as their share of the largest (glTF 2.0, KHR_mesh_quantization).
/// @param type  one of TINYGLTF_COMPONENT_TYPE, of at most four bytes, all of which can be read at `at`
double number_of_type(const void* at, int type, bool is_normalized);
/// Component `k` of the element in a row.
double number_at(const tinygltf::Model& model, const Column& column, std::size_t row, int k);

}  // namespace garmentfit
