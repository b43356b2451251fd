// SPDX-License-Identifier: GPL-3.0-or-later
#include "glb_appearance.h"

#include <map>
#include <numeric>
#include <utility>

namespace garmentfit {
namespace {

std::vector<double> values_of(const auto& vector) { return { vector.begin(), vector.end() }; }

/// @param first_texture  of those of this look
/// @param has_uvs        pictures need them
tinygltf::Material gltf_material(const SurfaceMaterial& given, int first_texture, bool has_uvs)
{
    tinygltf::Material material;
    const auto place = [&](auto& info, int picture) {
        if (picture >= 0 && has_uvs)
            info.index = first_texture + picture;
    };
    material.name = given.name;
    auto& metal = material.pbrMetallicRoughness;
    metal.baseColorFactor = values_of(given.colour);
    metal.metallicFactor = given.metallic;
    metal.roughnessFactor = given.roughness;
    material.emissiveFactor = values_of(given.emission);
    material.alphaMode = given.alpha;
    material.alphaCutoff = given.alpha == "MASK" ? given.alpha_cutoff : 0.5;  // written where it is not the default
    material.doubleSided = given.is_double_sided;
    material.normalTexture.scale = given.normal_scale;
    place(metal.baseColorTexture, given.colour_picture);
    place(metal.metallicRoughnessTexture, given.roughness_picture);
    place(material.normalTexture, given.normal_picture);
    place(material.occlusionTexture, given.occlusion_picture);
    place(material.emissiveTexture, given.emission_picture);
    return material;
}

/// Whether a material shows it: the format's validators complain of what nothing uses.
std::vector<int> rows_of_used_pictures(const Appearance& look)
{
    std::vector<int> rows(look.pictures.size(), -1);
    if (look.uvs.rows() == 0)
        return rows;
    int next = 0;
    for (const SurfaceMaterial& material : look.materials)
        for (const int picture : { material.colour_picture, material.roughness_picture, material.normal_picture,
                                   material.occlusion_picture, material.emission_picture })
            if (picture >= 0 && rows[std::size_t(picture)] < 0)
                rows[std::size_t(picture)] = next++;
    return rows;
}

void add_pictures(const Appearance& look, const std::vector<int>& rows, GlbModel& glb)
{
    const std::size_t first = glb.model.images.size();
    for (std::size_t p = 0; p < rows.size(); ++p) {
        if (rows[p] < 0)
            continue;
        const std::size_t place = first + std::size_t(rows[p]);
        glb.model.images.resize(std::max(glb.model.images.size(), place + 1));
        glb.model.textures.resize(glb.model.images.size());
        tinygltf::Image& image = glb.model.images[place];
        image.name = look.pictures[p].name;
        image.mimeType = look.pictures[p].mime_type;
        image.bufferView = glb.add_view(look.pictures[p].bytes.data(), look.pictures[p].bytes.size());
        glb.model.textures[place].source = int(place);
    }
}

}  // namespace

int add_materials(const Appearance& look, GlbModel& glb)
{
    const std::vector<int> rows = rows_of_used_pictures(look);
    const int first_texture = int(glb.model.images.size()), first_material = int(glb.model.materials.size());
    add_pictures(look, rows, glb);
    for (SurfaceMaterial material : look.materials) {
        for (int* picture : { &material.colour_picture, &material.roughness_picture, &material.normal_picture,
                              &material.occlusion_picture, &material.emission_picture })
            if (*picture >= 0)
                *picture = rows[std::size_t(*picture)];
        glb.model.materials.push_back(gltf_material(material, first_texture, look.uvs.rows() > 0));
    }
    return first_material;
}

SeamVertices split_at_seams(Eigen::Index vertices, const Triangles& triangles, const Appearance& look)
{
    SeamVertices result;
    result.sources.resize(std::size_t(vertices));
    std::iota(result.sources.begin(), result.sources.end(), 0);
    result.triangles = triangles;
    if (look.uv_corners.rows() != triangles.rows() || look.uvs.rows() == 0)
        return result;
    std::vector<int> uv_of(std::size_t(vertices), -1);
    std::map<std::pair<int, int>, int> copies;  // (vertex, row of uvs) -> vertex
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int vertex = triangles(f, k), uv = look.uv_corners(f, k);
            if (uv < 0)
                continue;
            if (int& own = uv_of[std::size_t(vertex)]; own < 0)
                own = uv;
            if (uv_of[std::size_t(vertex)] == uv)
                continue;
            const auto [entry, is_new] = copies.try_emplace({ vertex, uv }, int(result.sources.size()));
            if (is_new) {
                result.sources.push_back(vertex);
                uv_of.push_back(uv);
            }
            result.triangles(f, k) = entry->second;
        }
    result.uvs.setZero(Eigen::Index(uv_of.size()), 2);
    for (std::size_t v = 0; v < uv_of.size(); ++v)
        if (uv_of[v] >= 0)
            result.uvs.row(Eigen::Index(v)) = look.uvs.row(uv_of[v]);
    return result;
}

}  // namespace garmentfit
