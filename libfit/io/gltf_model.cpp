// SPDX-License-Identifier: GPL-3.0-or-later
#include "gltf_model.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "garmentfit/error.h"

namespace garmentfit {
namespace {

using nlohmann::ordered_json;

/// Only what geometry needs, so that mistakes in pictures, materials or animations do no harm.
ordered_json geometry_of(const ordered_json& json)
{
    ordered_json geometry = ordered_json::object();
    for (const char* key :
         { "asset", "buffers", "bufferViews", "accessors", "meshes", "nodes", "scenes", "scene", "skins" })
        if (json.contains(key))
            geometry[key] = json[key];
    if (geometry.contains("skins") && geometry["skins"].is_array())
        for (ordered_json& skin : geometry["skins"])
            if (skin.is_object() && !skin.contains("inverseBindMatrices"))
                skin["inverseBindMatrices"] = -1;  // optional in glTF, as all may be identities; not for tinygltf
    return geometry;
}

void require_readable(const FileBytes& file, const ordered_json& json)
{
    const std::string version = json.value("/asset/version"_json_pointer, std::string());
    if (!version.starts_with("2"))
        file.fail("is glTF version '" + version.substr(0, 10) + "'; export it as version 2");
}

bool read_beside(std::vector<unsigned char>* bytes, std::string* error, const std::string& path, void*)
{
    try {
        const FileBytes file = read_file(path);
        bytes->assign(file.bytes.begin(), file.bytes.end());
        return true;
    } catch (const InvalidInput& reason) {
        *error = reason.what();
        return false;
    }
}

/// The default ones of tinygltf would expand "~" and variables in the names of buffers, and read from devices.
tinygltf::FsCallbacks plain_files()
{
    tinygltf::FsCallbacks files {};
    files.FileExists = [](const std::string& path, void*) { return std::filesystem::is_regular_file(path); };
    files.ExpandFilePath = [](const std::string& path, void*) { return path; };
    files.ReadWholeFile = read_beside;
    return files;
}

}  // namespace

std::string first_line(const std::string& text) { return text.substr(0, std::min<std::size_t>(text.find('\n'), 200)); }

tinygltf::Model load_model(const FileBytes& file, const GltfContainer& container, const std::filesystem::path& folder)
{
    require_readable(file, container.json);
    GltfContainer reduced = container;
    reduced.json = geometry_of(container.json);
    reduced.is_indented = false;
    const std::string bytes = bytes_of(reduced);
    tinygltf::TinyGLTF loader;
    loader.SetFsCallbacks(plain_files());
    tinygltf::Model model;
    std::string error, warning;
    const auto size = static_cast<unsigned int>(bytes.size());
    const std::string base = folder.empty() ? "." : folder.string();
    const bool loaded = container.is_binary
        ? loader.LoadBinaryFromMemory(&model, &error, &warning, reinterpret_cast<const unsigned char*>(bytes.data()),
                                      size, base)
        : loader.LoadASCIIFromString(&model, &error, &warning, bytes.data(), size, base);
    if (!loaded || !error.empty())
        file.fail("is not valid glTF: " + first_line(error) + "; export the file again");
    return model;
}

Column column_of(const FileBytes& file, const tinygltf::Model& model, int index, const char* what)
{
    const tinygltf::Accessor& accessor = checked(file, model.accessors, index, "accessor");
    const std::string name = std::string(what) + " (accessor " + std::to_string(index) + ")";
    const tinygltf::BufferView& view = checked(file, model.bufferViews, accessor.bufferView, "bufferView");
    const tinygltf::Buffer& buffer = checked(file, model.buffers, view.buffer, "buffer");
    const int component = tinygltf::GetComponentSizeInBytes(accessor.componentType);
    const int components = tinygltf::GetNumComponentsInType(accessor.type);
    if (component <= 0 || components <= 0)
        file.fail(name + " has an unknown type; export the file again");
    const std::size_t element = std::size_t(component) * std::size_t(components);
    const Column column { index, view.buffer, view.byteOffset + accessor.byteOffset,
                          view.byteStride ? view.byteStride : element, accessor.count };
    const std::size_t size = buffer.data.size();
    const bool fits = view.byteOffset <= size && accessor.byteOffset <= size && column.begin <= size
        && element <= size - column.begin && column.stride >= element && column.count > 0
        && column.count - 1 <= (size - column.begin - element) / column.stride;
    if (!fits)
        file.fail(name + " reaches beyond its buffer of " + std::to_string(size)
                  + " bytes; it is truncated or mangled, export or copy it again");
    return column;
}

Column vector_column(const FileBytes& file, const tinygltf::Model& model, int index, const char* what)
{
    const Column column = column_of(file, model, index, what);
    const tinygltf::Accessor& accessor = model.accessors[index];
    if (accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT || accessor.type != TINYGLTF_TYPE_VEC3)
        file.fail(std::string(what) + " (accessor " + std::to_string(index)
                  + ") is not three floats; export it without quantization");
    return column;
}

double number_of_type(const void* at, int type, bool is_normalized)
{
    const auto read = [&](auto value) {
        std::memcpy(&value, at, sizeof value);
        using Number = decltype(value);
        return is_normalized ? std::max(double(value) / double(std::numeric_limits<Number>::max()), -1.0)
                             : double(value);
    };
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: return read(std::int8_t());
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return read(std::uint8_t());
    case TINYGLTF_COMPONENT_TYPE_SHORT: return read(std::int16_t());
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return read(std::uint16_t());
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: return read(std::uint32_t());
    default: {
        float value;
        std::memcpy(&value, at, sizeof value);
        return value;
    }
    }
}

double number_at(const tinygltf::Model& model, const Column& column, std::size_t row, int k)
{
    const tinygltf::Accessor& accessor = model.accessors[std::size_t(column.accessor)];
    const std::size_t size = std::size_t(tinygltf::GetComponentSizeInBytes(accessor.componentType));
    return number_of_type(model.buffers[std::size_t(column.buffer)].data.data() + column.offset(Eigen::Index(row))
                              + std::size_t(k) * size,
                          accessor.componentType, accessor.normalized);
}

}  // namespace garmentfit
