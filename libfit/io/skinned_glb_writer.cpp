// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <string>
#include <vector>

#include "garmentfit/io.h"
#include "garmentfit/mesh.h"
#include "garmentfit/skinned_gltf.h"
#include "glb_buffer.h"

namespace garmentfit {
namespace {

using nlohmann::ordered_json;
using namespace gltf;

constexpr std::array<const char*, extremity_count> k_last_joints { "head", "lhand", "rhand", "lfoot", "rfoot" };
constexpr std::array<const char*, extremity_count> k_tips { "head_top", "lhand_tip", "rhand_tip", "lfoot_tip",
                                                            "rfoot_tip" };

struct Joint {
    std::string name;
    int parent;  ///< -1: none
    Vec3 place;
};

/// The root, the bones in order, the last joints, the tips.
std::vector<Joint> joints_of(const Skeleton& skeleton)
{
    std::vector<Joint> joints { { "root", -1, skeleton.root } };
    for (int b = 0; b < bone_count; ++b)
        joints.push_back({ std::string(bone_name(b)), 1 + parent_of(b), skeleton.head(b) });
    for (int e = 0; e < extremity_count; ++e)
        joints.push_back({ k_last_joints[e], 1 + bone_before(Extremity(e)), skeleton.tail(bone_before(Extremity(e))) });
    for (int e = 0; e < extremity_count; ++e)
        joints.push_back({ k_tips[e], 1 + bone_count + e, skeleton.tips[e] });
    return joints;
}

/// Column by column as the format has them: to the joint's own axes, which are the world's.
Eigen::Matrix<double, Eigen::Dynamic, 16, Eigen::RowMajor> inverse_binds(const std::vector<Joint>& joints)
{
    Eigen::Matrix<double, Eigen::Dynamic, 16, Eigen::RowMajor> rows(joints.size(), 16);
    for (std::size_t j = 0; j < joints.size(); ++j) {
        Eigen::Matrix4d own_from_world = Eigen::Matrix4d::Identity();
        own_from_world.topRightCorner<3, 1>() = -joints[j].place;
        rows.row(Eigen::Index(j)) = Eigen::Map<const Eigen::Matrix<double, 1, 16>>(own_from_world.data());
    }
    return rows;
}

/// The body first, then the joints.
ordered_json nodes_of(const std::vector<Joint>& joints)
{
    ordered_json nodes { { { "name", "body" }, { "mesh", 0 }, { "skin", 0 } } };
    for (const Joint& joint : joints) {
        const Vec3 d = joint.parent < 0 ? joint.place : Vec3(joint.place - joints[std::size_t(joint.parent)].place);
        nodes.push_back({ { "name", joint.name }, { "translation", { d.x(), d.y(), d.z() } } });
    }
    for (std::size_t j = 0; j < joints.size(); ++j)
        if (joints[j].parent >= 0)
            nodes[std::size_t(joints[j].parent) + 1]["children"].push_back(j + 1);
    return nodes;
}

}  // namespace

void write_skinned_glb(const std::filesystem::path& path, const TriangleMesh& surface, const Rig& rig)
{
    const std::vector<Joint> joints = joints_of(rig.skeleton);
    GlbBuffer buffer;
    const int positions = buffer.add<float>(surface.positions, k_float, "VEC3", k_array_buffer);
    buffer.set_bounds(positions, surface.positions);
    const int normals
        = buffer.add<float>(vertex_normals(surface.positions, surface.triangles), k_float, "VEC3", k_array_buffer);
    const Eigen::MatrixXi used
        = (rig.weights.weights.array() > 0).select(rig.weights.bones.array() + 1, 0);  // 0 where unused
    const int bones = buffer.add<std::uint8_t>(used, k_unsigned_byte, "VEC4", k_array_buffer);
    const int weights = buffer.add<float>(rig.weights.weights, k_float, "VEC4", k_array_buffer);
    const int indices = buffer.add<std::uint32_t>(surface.triangles, k_unsigned_int, "SCALAR", k_element_array_buffer);
    const int binds = buffer.add<float>(inverse_binds(joints), k_float, "MAT4", 0);

    ordered_json json { { "asset", { { "version", "2.0" }, { "generator", "garmentfit" } } }, { "scene", 0 } };
    json["scenes"] = { { { "nodes", { 0, 1 } } } };
    json["nodes"] = nodes_of(joints);
    const ordered_json attributes {
        { "POSITION", positions }, { "NORMAL", normals }, { "JOINTS_0", bones }, { "WEIGHTS_0", weights }
    };
    json["meshes"]
        = { { { "name", "body" }, { "primitives", { { { "attributes", attributes }, { "indices", indices } } } } } };
    ordered_json all = ordered_json::array();
    for (std::size_t j = 0; j < joints.size(); ++j)
        all.push_back(j + 1);
    json["skins"] = { { { "joints", all }, { "skeleton", 1 }, { "inverseBindMatrices", binds } } };
    write_file(path, std::move(buffer).file(json));
}

}  // namespace garmentfit
