// SPDX-License-Identifier: GPL-3.0-or-later
#include "gltf_append.h"

#include <utility>

namespace garmentfit {
namespace {

using nlohmann::ordered_json;

void shift(ordered_json& object, const char* member, std::size_t by)
{
    if (object.contains(member))
        object[member] = object[member].get<std::size_t>() + by;
}

/// Textures of a material and of its parts.
void shift_textures(ordered_json& material, std::size_t by)
{
    for (auto& [name, value] : material.items())
        if (value.is_object()) {
            if (name.ends_with("Texture"))
                shift(value, "index", by);
            shift_textures(value, by);
        }
}

/// Makes what the lists of `added` refer to follow after what `json` has.
void shift_references(const ordered_json& json, std::size_t buffer_bytes, ordered_json& added)
{
    const std::size_t views = count_of(json, "bufferViews"), accessors = count_of(json, "accessors"),
                      images = count_of(json, "images"), textures = count_of(json, "textures"),
                      materials = count_of(json, "materials");
    const auto each = [&](const char* list, auto change) {
        if (added.contains(list))
            for (ordered_json& item : added[list])
                change(item);
    };
    each("bufferViews",
         [&](ordered_json& view) { view["byteOffset"] = view.value("byteOffset", std::size_t(0)) + buffer_bytes; });
    each("accessors", [&](ordered_json& accessor) { shift(accessor, "bufferView", views); });
    each("images", [&](ordered_json& image) { shift(image, "bufferView", views); });
    each("textures", [&](ordered_json& texture) { shift(texture, "source", images); });
    each("materials", [&](ordered_json& material) { shift_textures(material, textures); });
    each("meshes", [&](ordered_json& mesh) {
        for (ordered_json& primitive : mesh["primitives"]) {
            for (auto& [name, accessor] : primitive["attributes"].items())
                accessor = accessor.get<std::size_t>() + accessors;
            shift(primitive, "indices", accessors);
            shift(primitive, "material", materials);
        }
    });
}

/// VRM 0.x wants an entry for each material.
void add_vrm0_materials(ordered_json& json, const ordered_json& materials)
{
    if (!json.contains("extensions") || !json["extensions"].contains("VRM")
        || !json["extensions"]["VRM"].contains("materialProperties"))
        return;
    const ordered_json none = ordered_json::object();
    for (const ordered_json& material : materials)
        json["extensions"]["VRM"]["materialProperties"].push_back({ { "name", material.value("name", "") },
                                                                    { "shader", "VRM_USE_GLTFSHADER" },
                                                                    { "renderQueue", -1 },
                                                                    { "floatProperties", none },
                                                                    { "vectorProperties", none },
                                                                    { "textureProperties", none },
                                                                    { "keywordMap", none },
                                                                    { "tagMap", none } });
}

}  // namespace

void append_model(GltfContainer& container, GltfContainer added)
{
    std::string& buffer = *container.own_buffer();
    buffer.resize((buffer.size() + 3) / 4 * 4, '\0');
    shift_references(container.json, buffer.size(), added.json);
    buffer += *added.own_buffer();
    container.json["buffers"][0]["byteLength"] = buffer.size();
    if (added.json.contains("materials"))
        add_vrm0_materials(container.json, added.json["materials"]);
    for (const char* list : { "bufferViews", "accessors", "images", "textures", "materials", "meshes" })
        if (added.json.contains(list))
            for (ordered_json& item : added.json[list])
                container.json[list].push_back(std::move(item));
}

ordered_json& primitive_in(ordered_json& json, const tinygltf::Model& model, const GltfSurface& surface)
{
    const std::size_t mesh = std::size_t(model.nodes[std::size_t(surface.node)].mesh);
    const auto row = surface.primitive - model.meshes[mesh].primitives.data();
    return json["meshes"][mesh]["primitives"][std::size_t(row)];
}

}  // namespace garmentfit
