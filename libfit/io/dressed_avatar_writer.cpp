// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <map>

#include "garmentfit/error.h"
#include "garmentfit/io.h"
#include "garmentfit/skinned_gltf.h"
#include "glb_skinned_mesh.h"
#include "gltf_append.h"
#include "gltf_container.h"
#include "gltf_model.h"
#include "gltf_scene.h"
#include "gltf_skin.h"
#include "gltf_unpack.h"
#include "tidy_skin.h"

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

// ---- weights -------------------------------------------------------------------------------------------------------

JointWeights joint_weights(const FileSkin& skin)
{
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t v = 0; v < skin.hangs.size(); ++v) {
        double sum = 0;
        for (const auto& [joint, weight] : skin.hangs[v])
            sum += positive(weight);
        for (const auto& [joint, weight] : skin.hangs[v])
            if (positive(weight) > 0)
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

// ---- the file ----------------------------------------------------------------------------------------------------------

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
            mask.accessor = add_accessor<float>(avatar.container, mask.values, TINYGLTF_TYPE_SCALAR,
                                                TINYGLTF_TARGET_ARRAY_BUFFER);
        }
        const Triangles shown = shown_faces(avatar, surface, mask.values);
        if (shown.rows() == 0)
            continue;
        const std::size_t indices = add_accessor<std::uint32_t>(avatar.container, shown, TINYGLTF_TYPE_SCALAR,
                                                                TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
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
    return joint_weights(read_skin(avatar.file, avatar.model));
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
        move_pictures_into_buffer(avatar.container);
        tidy_weights(avatar.container, avatar.file, avatar.model, skin, joint_weights(skin));
        if (!covered.empty())
            hide_covered(avatar, covered);
        free_skinned_meshes(avatar.container.json);
        add_garments(avatar.container, skin, garments);
    } catch (const ordered_json::exception& error) {  // a member of an unexpected type
        avatar.file.fail("is not valid glTF: " + first_line(error.what()) + "; export the file again");
    }
    write_file(path, bytes_of(avatar.container));
}

}  // namespace garmentfit
