// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "garmentfit/error.h"
#include "garmentfit/io.h"
#include "garmentfit/skinned_gltf.h"
#include "glb_skinned_mesh.h"
#include "gltf_container.h"
#include "gltf_model.h"
#include "gltf_scene.h"
#include "gltf_skin.h"
#include "gltf_unpack.h"

namespace garmentfit {
namespace {

using nlohmann::ordered_json;

/// The file of an avatar, its geometry plain.
struct Avatar {
    FileBytes file;
    GltfContainer container;
    tinygltf::Model model;

    explicit Avatar(const std::filesystem::path& path) :
        file(read_file(path)), container(read_plain_gltf(file, path.parent_path())),
        model(load_model(file, container, path.parent_path()))
    {
    }
};

std::size_t count_of(const ordered_json& json, const char* list) { return json.contains(list) ? json[list].size() : 0; }

// ---- weights -------------------------------------------------------------------------------------------------------

JointWeights joint_weights(const FileBytes& file, const FileSkin& skin)
{
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t v = 0; v < skin.hangs.size(); ++v) {
        double sum = 0;
        for (const auto& [joint, weight] : skin.hangs[v])
            sum += std::max(weight, 0.0);
        if (!std::isfinite(sum))
            file.fail("vertex " + std::to_string(v) + " has a weight without a limit; export the weights again");
        for (const auto& [joint, weight] : skin.hangs[v])
            if (weight > 0)
                entries.emplace_back(int(v), joint, weight / sum);
    }
    JointWeights weights(Eigen::Index(skin.hangs.size()), Eigen::Index(skin.nodes.size()));
    weights.setFromTriplets(entries.begin(), entries.end());  // adds up what a joint has twice
    return weights;
}

/// Joints that move one of the garments: viewers want a common root for those of a skin, and a file may have several
/// figures.
std::vector<int> list_used_joints(const std::vector<AvatarGarment>& garments, std::size_t joints)
{
    std::vector<char> is_used(joints, 0);
    for (const AvatarGarment& garment : garments)
        for (Eigen::Index v = 0; v < garment.weights.rows(); ++v)
            for (JointWeights::InnerIterator entry(garment.weights, v); entry; ++entry)
                is_used[std::size_t(entry.col())] = 1;
    std::vector<int> used;
    for (std::size_t j = 0; j < joints; ++j)
        if (is_used[j])
            used.push_back(int(j));
    return used;
}

void require_rows(const std::vector<AvatarGarment>& garments, std::size_t joints)
{
    for (const AvatarGarment& garment : garments)
        if (garment.weights.rows() != garment.surface.positions.rows()
            || garment.weights.cols() != Eigen::Index(joints))
            throw InvalidInput(ErrorCode::count_mismatch,
                               "dressed avatar: " + garment.name + " has "
                                   + std::to_string(garment.surface.positions.rows()) + " vertices, and weights of "
                                   + std::to_string(garment.weights.rows()) + " over "
                                   + std::to_string(garment.weights.cols()) + " of " + std::to_string(joints)
                                   + " joints; give a row for each vertex and a column for each joint");
}

// ---- one model more in a file --------------------------------------------------------------------------------------

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

/// Appends buffer, accessors, materials, pictures and meshes.
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

/// GLB with a single buffer.
void make_binary(Avatar& avatar)
{
    std::vector<std::string> buffers;
    for (const tinygltf::Buffer& buffer : avatar.model.buffers)
        buffers.emplace_back(buffer.data.begin(), buffer.data.end());
    GltfContainer& container = avatar.container;
    container.chunks = { { k_binary_type, merge_buffers(avatar.file, container.json, buffers) } };
    container.is_binary = true;
}

// ---- clothes -------------------------------------------------------------------------------------------------------

Eigen::Matrix<double, Eigen::Dynamic, 16, Eigen::RowMajor> inverse_binds(const FileSkin& skin,
                                                                         const std::vector<int>& joints)
{
    Eigen::Matrix<double, Eigen::Dynamic, 16, Eigen::RowMajor> rows(joints.size(), 16);
    for (std::size_t j = 0; j < joints.size(); ++j) {
        const Eigen::Matrix4d bind = skin.joint_from_world[std::size_t(joints[j])].matrix();
        rows.row(Eigen::Index(j)) = Eigen::Map<const Eigen::Matrix<double, 1, 16>>(bind.data());
    }
    return rows;
}

/// Adds the meshes, a skin that they share, and their nodes.
void add_garments(GltfContainer& container, const FileSkin& skin, const std::vector<AvatarGarment>& garments)
{
    const std::vector<int> joints = list_used_joints(garments, skin.nodes.size());
    GlbModel glb;
    for (const AvatarGarment& garment : garments)
        glb.model.meshes.push_back(
            gltf_mesh({ garment.name, garment.surface, {}, garment.look }, file_weights(garment.weights, joints), glb));
    const int binds = glb.add<float>(inverse_binds(skin, joints), TINYGLTF_TYPE_MAT4);

    ordered_json& json = container.json;
    const std::size_t first_mesh = count_of(json, "meshes"), first_accessor = count_of(json, "accessors"),
                      skin_row = count_of(json, "skins");
    append_model(container, read_gltf_container({ "clothes", glb.file() }));
    ordered_json nodes = ordered_json::array();
    for (const int joint : joints)
        nodes.push_back(skin.nodes[std::size_t(joint)]);
    json["skins"].push_back({ { "name", "clothes" },
                              { "joints", std::move(nodes) },
                              { "inverseBindMatrices", first_accessor + std::size_t(binds) } });
    for (std::size_t g = 0; g < garments.size(); ++g) {
        if (count_of(json, "scenes") > 0)
            json["scenes"][json.value("scene", std::size_t(0))]["nodes"].push_back(count_of(json, "nodes"));
        json["nodes"].push_back({ { "name", garments[g].name }, { "mesh", first_mesh + g }, { "skin", skin_row } });
    }
}

// ---- covered skin --------------------------------------------------------------------------------------------------

/// Adds an accessor with values of its own. @return its index
template <class Number, class Matrix>
std::size_t add_accessor(GltfContainer& container, const Matrix& values, int target)
{
    GlbModel glb;
    glb.add<Number>(values, TINYGLTF_TYPE_SCALAR, target);
    append_model(container, read_gltf_container({ "covered", glb.file() }));
    return count_of(container.json, "accessors") - 1;
}

ordered_json& primitive_in(ordered_json& json, const tinygltf::Model& model, const GltfSurface& surface)
{
    const std::size_t mesh = std::size_t(model.nodes[std::size_t(surface.node)].mesh);
    const auto row = surface.primitive - model.meshes[mesh].primitives.data();
    return json["meshes"][mesh]["primitives"][std::size_t(row)];
}

/// What a surface shows once covered faces are left out. One of them stays where no other is left: glTF knows no empty
/// mesh, and expressions may refer to it.
Triangles shown_faces(const Avatar& avatar, const GltfSurface& surface, const Eigen::VectorXf& covered)
{
    const std::vector<std::array<int, 3>> all
        = triangles_of(avatar.file, avatar.model, *surface.primitive, surface.positions.count);
    std::vector<std::array<int, 3>> shown;
    for (const std::array<int, 3>& face : all)
        if (!std::all_of(face.begin(), face.end(), [&](int v) { return covered[v] > 0; }))
            shown.push_back(face);
    if (shown.empty() && !all.empty())
        shown.push_back(all.front());
    Triangles result(Eigen::Index(shown.size()), 3);
    for (std::size_t f = 0; f < shown.size(); ++f)
        result.row(Eigen::Index(f)) << shown[f][0], shown[f][1], shown[f][2];
    return result;
}

/// Marks covered vertices and leaves out covered faces.
void hide_covered(Avatar& avatar, const std::vector<char>& covered)
{
    struct Mask {
        Eigen::VectorXf values;
        std::size_t accessor;
    };
    std::map<std::pair<int, std::size_t>, Mask> masks;  // by (buffer, first byte) of the positions
    std::size_t first = 0;
    for (const GltfSurface& surface : GltfScene(avatar.file, avatar.model).surfaces()) {
        Mask& mask = masks[{ surface.positions.buffer, surface.positions.begin }];
        if (surface.adds_vertices) {
            mask.values.resize(Eigen::Index(surface.positions.count));
            for (Eigen::Index v = 0; v < mask.values.size(); ++v)
                mask.values[v] = covered[first + std::size_t(v)];
            first += surface.positions.count;
            mask.accessor = add_accessor<float>(avatar.container, mask.values, TINYGLTF_TARGET_ARRAY_BUFFER);
        }
        const Triangles shown = shown_faces(avatar, surface, mask.values);
        if (shown.rows() == 0)
            continue;
        const std::size_t indices
            = add_accessor<std::uint32_t>(avatar.container, shown, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
        ordered_json& primitive = primitive_in(avatar.container.json, avatar.model, surface);
        primitive["attributes"]["_COVERED"] = mask.accessor;
        primitive["indices"] = indices;
        primitive["mode"] = TINYGLTF_MODE_TRIANGLES;
    }
}

}  // namespace

JointWeights read_joint_weights(const std::filesystem::path& path)
{
    const Avatar avatar(path);
    return joint_weights(avatar.file, read_skin(avatar.file, avatar.model));
}

bool is_vrm(const std::filesystem::path& path)
{
    const ordered_json json = read_plain_gltf(read_file(path), path.parent_path()).json;
    const ordered_json extensions = json.value("extensions", ordered_json::object());
    return extensions.contains("VRM") || extensions.contains("VRMC_vrm");
}

void write_dressed_avatar(const std::filesystem::path& path, const std::filesystem::path& avatar_path,
                          const std::vector<AvatarGarment>& garments, const std::vector<char>& covered)
{
    Avatar avatar(avatar_path);
    const FileSkin skin = read_skin(avatar.file, avatar.model);
    require_rows(garments, skin.nodes.size());
    if (!covered.empty() && covered.size() != skin.hangs.size())
        throw InvalidInput(ErrorCode::count_mismatch,
                           "dressed avatar: " + std::to_string(covered.size()) + " marks of covered skin for "
                               + std::to_string(skin.hangs.size()) + " vertices; give one for each");
    try {
        embed_pictures(avatar.container.json, avatar_path.parent_path());
        fill_missing_pictures(avatar.container.json);
        make_binary(avatar);
        if (!covered.empty())
            hide_covered(avatar, covered);
        add_garments(avatar.container, skin, garments);
    } catch (const ordered_json::exception& error) {  // a member of an unexpected type
        avatar.file.fail("is not valid glTF: " + first_line(error.what()) + "; export the file again");
    }
    write_file(path, bytes_of(avatar.container));
}

}  // namespace garmentfit
