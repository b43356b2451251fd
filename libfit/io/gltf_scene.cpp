// SPDX-License-Identifier: GPL-3.0-or-later
#include "gltf_scene.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "garmentfit/error.h"

namespace garmentfit {
namespace {

void require_sizes(const FileBytes& file, const tinygltf::Node& node)
{
    const auto is
        = [](const std::vector<double>& values, std::size_t size) { return values.empty() || values.size() == size; };
    if (!is(node.matrix, 16) || !is(node.translation, 3) || !is(node.rotation, 4) || !is(node.scale, 3))
        file.fail("node '" + first_line(node.name) + "' has a transform of the wrong length; export the file again");
}

Eigen::Affine3d parent_from_node(const FileBytes& file, const tinygltf::Node& node)
{
    require_sizes(file, node);
    Eigen::Affine3d transform = Eigen::Affine3d::Identity();
    if (!node.matrix.empty()) {
        transform.matrix().topRows<3>() = Eigen::Matrix4d::Map(node.matrix.data()).topRows<3>();
        return transform;
    }
    if (!node.translation.empty())
        transform.translate(Vec3::Map(node.translation.data()));
    if (!node.rotation.empty())
        transform.rotate(
            Eigen::Quaterniond(Eigen::Vector4d::Map(node.rotation.data())).normalized());  // x y z w, as in Eigen
    if (!node.scale.empty())
        transform.scale(Vec3::Map(node.scale.data()));
    return transform;
}

std::vector<int> indices_of(const FileBytes& file, const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                            std::size_t vertices)
{
    std::vector<int> indices;
    if (primitive.indices < 0) {
        for (std::size_t i = 0; i < vertices; ++i)
            indices.push_back(static_cast<int>(i));
        return indices;
    }
    const Column column = column_of(file, model, primitive.indices, "indices");
    const tinygltf::Accessor& accessor = model.accessors[primitive.indices];
    const std::size_t bytes = tinygltf::GetComponentSizeInBytes(accessor.componentType);
    const bool is_unsigned = accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE
        || accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT
        || accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    if (!is_unsigned || accessor.type != TINYGLTF_TYPE_SCALAR)
        file.fail("indices (accessor " + std::to_string(column.accessor)
                  + ") are not unsigned integers; export the file again");
    for (std::size_t i = 0; i < column.count; ++i) {
        std::uint32_t index = 0;
        std::memcpy(&index, model.buffers[column.buffer].data.data() + column.offset(i), bytes);
        if (index >= vertices)
            file.fail("indices (accessor " + std::to_string(column.accessor) + "), entry " + std::to_string(i)
                          + ", refers to vertex " + std::to_string(index) + ", but there are "
                          + std::to_string(vertices) + ", counted from 0; export the file again",
                      ErrorCode::bad_index);
        indices.push_back(static_cast<int>(index));
    }
    return indices;
}

}  // namespace

std::vector<std::array<int, 3>> triangles_of(const FileBytes& file, const tinygltf::Model& model,
                                             const tinygltf::Primitive& primitive, std::size_t vertices)
{
    const std::vector<int> indices = indices_of(file, model, primitive, vertices);
    const bool is_fan = primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN,
               is_strip = primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP;
    std::vector<std::array<int, 3>> triangles;
    for (std::size_t i = 0; i + 2 < indices.size(); i += is_fan || is_strip ? 1 : 3) {
        const std::size_t first = is_fan ? 0 : i;
        if (is_strip && i % 2 == 1)  // every other one is wound the other way
            triangles.push_back({ indices[first], indices[i + 2], indices[i + 1] });
        else
            triangles.push_back({ indices[first], indices[i + 1], indices[i + 2] });
    }
    return triangles;
}

GltfScene::GltfScene(const FileBytes& file, const tinygltf::Model& model) :
    file_(file), model_(model), parents_(model.nodes.size(), -1),
    world_from_node_(model.nodes.size(), Eigen::Affine3d::Identity())
{
    std::vector<char> is_seen(model.nodes.size(), 0);
    std::vector<std::pair<int, int>> open;  // node, parent
    const auto push = [&](const std::vector<int>& children, int parent) {
        for (auto child = children.rbegin(); child != children.rend(); ++child)
            open.emplace_back(*child, parent);
    };
    push(roots(), -1);
    while (!open.empty()) {
        const auto [index, parent] = open.back();
        open.pop_back();
        const tinygltf::Node& node = checked(file, model.nodes, index, "node");
        if (std::exchange(is_seen[std::size_t(index)], 1))
            file.fail("node " + std::to_string(index) + " has two parents; export the file again");
        const Eigen::Affine3d world_from_parent
            = parent < 0 ? Eigen::Affine3d::Identity() : world_from_node_[std::size_t(parent)];
        nodes_.push_back(index);
        parents_[std::size_t(index)] = parent;
        world_from_node_[std::size_t(index)] = world_from_parent * parent_from_node(file, node);
        push(node.children, index);
    }
}

std::vector<int> GltfScene::roots() const
{
    if (!model_.scenes.empty())
        return checked(file_, model_.scenes, std::max(model_.defaultScene, 0), "scene").nodes;
    std::vector<bool> is_child(model_.nodes.size());
    for (const tinygltf::Node& node : model_.nodes)
        for (const int child : node.children)
            if (child >= 0 && std::size_t(child) < is_child.size())
                is_child[std::size_t(child)] = true;
    std::vector<int> nodes;
    for (std::size_t node = 0; node < is_child.size(); ++node)
        if (!is_child[node])
            nodes.push_back(int(node));
    return nodes;
}

Eigen::Matrix4d GltfScene::inverse_bind_matrix(const tinygltf::Skin& skin, std::size_t joint) const
{
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
    if (skin.inverseBindMatrices < 0)
        return matrix;
    const Column column = column_of(file_, model_, skin.inverseBindMatrices, "inverseBindMatrices");
    const tinygltf::Accessor& accessor = model_.accessors[std::size_t(column.accessor)];
    if (accessor.type != TINYGLTF_TYPE_MAT4 || accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT
        || column.count < skin.joints.size())
        file_.fail("has no inverse bind matrix for each joint; export the skin with its bind pose");
    for (int k = 0; k < 16; ++k)
        matrix(k % 4, k / 4) = number_at(model_, column, joint, k);
    return matrix;
}

bool GltfScene::has_bind_pose(const tinygltf::Skin& skin) const
{
    constexpr double k_precision = 1e-3;  // unit: more than the rounding of matrices that were multiplied as floats
    const Eigen::RowVector4d last_row(0, 0, 0, 1);
    for (std::size_t joint = 0; joint < skin.joints.size(); ++joint) {
        const Eigen::Matrix4d matrix = inverse_bind_matrix(skin, joint);
        if (!matrix.allFinite() || !((matrix.row(3) - last_row).cwiseAbs().maxCoeff() < k_precision))
            return false;
    }
    return true;
}

Eigen::Affine3d GltfScene::joint_from_mesh(const tinygltf::Skin& skin, std::size_t joint) const
{
    return Eigen::Affine3d(Eigen::AffineCompact3d(inverse_bind_matrix(skin, joint).topRows<3>()));
}

namespace {

/// Of each skin, where it puts its meshes.
using SkinPlaces = std::map<int, Eigen::Affine3d>;

Eigen::Affine3d world_by_joint(const GltfScene& scene, const tinygltf::Skin& skin, std::size_t joint)
{
    return scene.world_from_node(skin.joints[joint]) * scene.joint_from_mesh(skin, joint);
}

/// Skins of the scene's meshes that have joints and a bind pose.
std::set<int> posed_skins(const GltfScene& scene, const FileBytes& file, const tinygltf::Model& model)
{
    std::set<int> skins;
    for (const int node : scene.nodes())
        if (const int index = model.nodes[std::size_t(node)].skin;
            model.nodes[std::size_t(node)].mesh >= 0 && index >= 0) {
            const tinygltf::Skin& skin = checked(file, model.skins, index, "skin");
            for (const int joint : skin.joints)
                checked(file, model.nodes, joint, "node");
            if (!skin.joints.empty() && scene.has_bind_pose(skin))
                skins.insert(index);
        }
    return skins;
}

/// The skin that has the first joint in the tree, placed by that.
SkinPlaces::value_type first_in_tree(const GltfScene& scene, const tinygltf::Model& model, const std::set<int>& skins)
{
    for (const int node : scene.nodes())
        for (const int index : skins) {
            const tinygltf::Skin& skin = model.skins[std::size_t(index)];
            if (const auto joint = std::find(skin.joints.begin(), skin.joints.end(), node); joint != skin.joints.end())
                return { index, world_by_joint(scene, skin, std::size_t(joint - skin.joints.begin())) };
        }
    return { *skins.begin(), world_by_joint(scene, model.skins[std::size_t(*skins.begin())], 0) };
}

/// Between the meshes of two skins that share a joint, by its node or its name: in bind pose it lies at one place.
std::optional<Eigen::Affine3d> mesh_from_mesh(const GltfScene& scene, const tinygltf::Model& model,
                                              const tinygltf::Skin& to, const tinygltf::Skin& from)
{
    for (std::size_t i = 0; i < to.joints.size(); ++i)
        for (std::size_t k = 0; k < from.joints.size(); ++k) {
            const std::string& name = model.nodes[std::size_t(to.joints[i])].name;
            if (to.joints[i] != from.joints[k]
                && (name.empty() || name != model.nodes[std::size_t(from.joints[k])].name))
                continue;
            const Eigen::Affine3d joined = scene.joint_from_mesh(to, i).inverse() * scene.joint_from_mesh(from, k);
            if (joined.matrix().allFinite())
                return joined;
        }
    return {};
}

/// Skins that share joints are placed by one joint. Each by its own first one, the parts of a posed avatar would lie
/// apart.
SkinPlaces place_skins(const GltfScene& scene, const FileBytes& file, const tinygltf::Model& model)
{
    std::set<int> open = posed_skins(scene, file, model);
    SkinPlaces placed;
    const auto next_by_others = [&]() -> std::optional<SkinPlaces::value_type> {
        for (const int skin : open)
            for (const auto& [other, world_from_other] : placed)
                if (const auto joined
                    = mesh_from_mesh(scene, model, model.skins[std::size_t(other)], model.skins[std::size_t(skin)]))
                    return { { skin, world_from_other * *joined } };
        return {};
    };
    while (open.size() > 0) {
        const auto by_others = next_by_others();
        open.erase(placed.insert(by_others ? *by_others : first_in_tree(scene, model, open)).first->first);
    }
    return placed;
}

}  // namespace

Eigen::Affine3d GltfScene::world_from_mesh(int node) const
{
    constexpr double k_same = 1e-4;  // unit: more than the rounding of products of float matrices
    const int index = model_.nodes[std::size_t(node)].skin;
    if (index < 0)
        return world_from_node(node);
    const tinygltf::Skin& skin = checked(file_, model_.skins, index, "skin");
    if (skin.joints.empty())
        return Eigen::Affine3d::Identity();
    checked(file_, model_.nodes, skin.joints[0], "node");
    if (!has_bind_pose(skin))
        return world_from_node(node);
    const Eigen::Affine3d by_first = world_by_joint(*this, skin, 0);
    if (!world_from_skin_)
        world_from_skin_ = place_skins(*this, file_, model_);
    const auto place = world_from_skin_->find(index);
    return place == world_from_skin_->end() || place->second.isApprox(by_first, k_same) ? by_first : place->second;
}

std::vector<GltfSurface> GltfScene::surfaces() const
{
    std::vector<GltfSurface> surfaces;
    std::set<std::pair<int, std::size_t>> seen;  // (buffer, first byte)
    for (const int node : nodes_) {
        const int mesh = model_.nodes[std::size_t(node)].mesh;
        if (mesh < 0)
            continue;
        for (const tinygltf::Primitive& primitive : checked(file_, model_.meshes, mesh, "mesh").primitives) {
            const auto position = primitive.attributes.find("POSITION");
            const bool is_surface = primitive.mode < 0 || primitive.mode >= TINYGLTF_MODE_TRIANGLES;
            if (position == primitive.attributes.end() || !is_surface)
                continue;
            const Column column = vector_column(file_, model_, position->second, "POSITION");
            surfaces.push_back({ node, &primitive, column, seen.insert({ column.buffer, column.begin }).second });
        }
    }
    return surfaces;
}

}  // namespace garmentfit
