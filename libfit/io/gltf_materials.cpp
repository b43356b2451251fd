// SPDX-License-Identifier: GPL-3.0-or-later
#include "gltf_materials.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "gltf_scene.h"
#include "pictures.h"

namespace garmentfit {
namespace {

using nlohmann::ordered_json;

class AppearanceReader {
public:
    AppearanceReader(const FileBytes& file, const tinygltf::Model& model, const ordered_json& json,
                     std::vector<std::string>& warnings) :
        file_(file),
        model_(model), json_(json), warnings_of_pictures_(warnings)
    {
    }

    Appearance read(const std::vector<GltfPart>& parts, const Triangles& triangles)
    {
        for (const ordered_json& material : list(json_, "materials"))
            look_.materials.push_back(material_of(material));
        look_.uv_corners.setConstant(triangles.rows(), 3, -1);
        Eigen::Index row = 0;
        for (const GltfPart& part : parts) {
            add_uvs(part, triangles, row);
            const int material = part.primitive->material;
            look_.material_of.insert(look_.material_of.end(), std::size_t(part.triangles),
                                     material < int(look_.materials.size()) ? material : -1);
            row += part.triangles;
        }
        if (look_.materials.empty())
            look_.material_of.clear();
        look_.uvs = Eigen::Map<const decltype(look_.uvs)>(uvs_.data(), Eigen::Index(uvs_.size() / 2), 2);
        if (uvs_.empty())
            look_.uv_corners.resize(0, 3);
        return std::move(look_);
    }

private:
    void warn(const std::string& what) { look_.warnings.push_back(what); }

    // ---- materials: the model has none, it is made for geometry ----

    static const ordered_json& list(const ordered_json& owner, const char* name)
    {
        static const ordered_json none = ordered_json::array();
        const auto found = owner.find(name);
        return found != owner.end() && found->is_array() ? *found : none;
    }

    static const ordered_json& object(const ordered_json& owner, const char* name)
    {
        static const ordered_json none = ordered_json::object();
        const auto found = owner.find(name);
        return found != owner.end() && found->is_object() ? *found : none;
    }

    template <class Vector>
    static void read_shares(const ordered_json& owner, const char* name, Vector& values)
    {
        const ordered_json& given = list(owner, name);
        for (std::size_t i = 0; i < given.size() && Eigen::Index(i) < values.size(); ++i)
            values[Eigen::Index(i)] = std::clamp(given[i].get<double>(), 0.0, 1.0);
    }

    SurfaceMaterial material_of(const ordered_json& given)
    {
        const ordered_json& metal = object(given, "pbrMetallicRoughness");
        SurfaceMaterial result;
        result.name = given.value("name", "");
        read_shares(metal, "baseColorFactor", result.colour);
        read_shares(given, "emissiveFactor", result.emission);
        result.metallic = std::clamp(metal.value("metallicFactor", 1.0), 0.0, 1.0);
        result.roughness = std::clamp(metal.value("roughnessFactor", 1.0), 0.0, 1.0);
        if (const std::string alpha = given.value("alphaMode", ""); alpha == "MASK" || alpha == "BLEND")
            result.alpha = alpha;
        result.alpha_cutoff = std::max(0.0, given.value("alphaCutoff", 0.5));
        result.normal_scale = object(given, "normalTexture").value("scale", 1.0);
        result.is_double_sided = given.value("doubleSided", false);
        result.colour_picture = picture_of(metal, "baseColorTexture", result.name);
        result.roughness_picture = picture_of(metal, "metallicRoughnessTexture", result.name);
        result.normal_picture = picture_of(given, "normalTexture", result.name);
        result.occlusion_picture = picture_of(given, "occlusionTexture", result.name);
        result.emission_picture = picture_of(given, "emissiveTexture", result.name);
        for (const auto& [extension, value] : object(given, "extensions").items())
            warn("material " + first_line(result.name) + ": " + first_line(extension) + " is left out of outfits");
        return result;
    }

    int picture_of(const ordered_json& owner, const char* name, const std::string& material)
    {
        const ordered_json& info = object(owner, name);
        const ordered_json& textures = list(json_, "textures");
        const int texture = info.value("index", -1);
        if (texture < 0 || std::size_t(texture) >= textures.size())
            return -1;
        if (info.value("texCoord", 0) != 0 || info.contains("extensions")) {
            warn("material " + first_line(material)
                 + ": a texture with a second set of UVs or a transform is left out of outfits");
            return -1;
        }
        const auto [entry, is_new] = picture_rows_.try_emplace(textures[std::size_t(texture)].value("source", -1), -1);
        if (is_new)
            entry->second = picture(entry->first);
        return entry->second;
    }

    int picture(int index)
    {
        const ordered_json& images = list(json_, "images");
        if (index < 0 || std::size_t(index) >= images.size()) {
            warn("a texture in a format of an extension is left out of outfits; export it as PNG or JPEG");
            return -1;
        }
        const ordered_json& image = images[std::size_t(index)];
        const std::string given = first_line(image.value("name", ""));
        const std::string name = given.empty() ? "texture " + std::to_string(index) : given;
        const std::string bytes = picture_bytes(image);
        if (bytes.empty()) {
            if (file_of_picture(image).empty())  // else said of the file already
                warn("texture " + name + " cannot be read; put it beside the file");
            return -1;
        }
        if (const std::string warning = warning_of_size(name, bytes); !warning.empty())
            warnings_of_pictures_.push_back(warning);
        return add_picture(look_, name, bytes);
    }

    std::string picture_bytes(const ordered_json& image) const
    {
        if (const auto view = image.find("bufferView"); view != image.end() && view->is_number_integer()) {
            const tinygltf::BufferView& part = checked(file_, model_.bufferViews, view->get<int>(), "bufferView");
            const auto& data = checked(file_, model_.buffers, part.buffer, "buffer").data;
            if (part.byteOffset > data.size() || part.byteLength > data.size() - part.byteOffset)
                return {};
            return { data.begin() + std::ptrdiff_t(part.byteOffset),
                     data.begin() + std::ptrdiff_t(part.byteOffset + part.byteLength) };
        }
        std::vector<unsigned char> bytes;
        std::string type;
        if (!tinygltf::DecodeDataURI(&bytes, type, image.value("uri", ""), 0, false))
            return {};
        return { bytes.begin(), bytes.end() };
    }

    // ---- UVs ----

    void add_uvs(const GltfPart& part, const Triangles& triangles, Eigen::Index first_triangle)
    {
        const auto attribute = part.primitive->attributes.find("TEXCOORD_0");
        if (attribute == part.primitive->attributes.end())
            return;
        try {
            const std::pair key(attribute->second, part.first_row);
            if (!first_uv_.count(key)) {
                const int first = int(uvs_.size() / 2);
                append_uvs(attribute->second);  // or throws
                first_uv_[key] = first;
            }
            const auto own = triangles.middleRows(first_triangle, part.triangles);
            const int count = int(model_.accessors[std::size_t(attribute->second)].count);
            if (part.triangles > 0 && own.maxCoeff() - part.first_row >= count)
                file_.fail("TEXCOORD_0 has fewer rows than POSITION");
            look_.uv_corners.middleRows(first_triangle, part.triangles)
                = own.array() - int(part.first_row) + first_uv_[key];
        } catch (const InvalidInput& error) {
            warn(std::string("UVs are left out: ") + error.what());
        }
    }

    void append_uvs(int accessor)
    {
        const Column column = column_of(file_, model_, accessor, "TEXCOORD_0");
        const tinygltf::Accessor& given = model_.accessors[std::size_t(accessor)];
        if (given.type != TINYGLTF_TYPE_VEC2)
            file_.fail("TEXCOORD_0 (accessor " + std::to_string(accessor) + ") has not two numbers");
        for (std::size_t row = 0; row < column.count; ++row)
            for (int k = 0; k < 2; ++k) {
                const double value = number_at(model_, column, row, k);
                uvs_.push_back(std::isfinite(value) ? value : 0);
            }
    }

    const FileBytes& file_;
    const tinygltf::Model& model_;
    const ordered_json& json_;
    std::vector<std::string>& warnings_of_pictures_;
    Appearance look_;
    std::map<int, int> picture_rows_;  // by image
    std::map<std::pair<int, Eigen::Index>, int> first_uv_;  // by accessor and first row
    std::vector<double> uvs_;
};

/// Those that stay beside the file once all others are in it.
void warn_of_missing_pictures(const ordered_json& json, std::vector<std::string>& warnings)
{
    for (const ordered_json& image : json.value("images", ordered_json::array()))
        if (const std::string name = file_of_picture(image); !name.empty())
            warnings.push_back("texture " + first_line(name) + " cannot be read; put it beside the file");
}

}  // namespace

Appearance gltf_appearance(const FileBytes& file, const tinygltf::Model& model, const ordered_json& json,
                           const std::vector<GltfPart>& parts, const Triangles& triangles,
                           std::vector<std::string>& warnings)
{
    try {
        warn_of_missing_pictures(json, warnings);
        return AppearanceReader(file, model, json, warnings).read(parts, triangles);
    } catch (const std::exception& error) {
        Appearance none;
        none.warnings.push_back(std::string("materials are left out of outfits: ") + first_line(error.what()));
        return none;
    }
}

}  // namespace garmentfit
