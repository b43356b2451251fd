// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <numeric>
#include <string>
#include <vector>

#include "garmentfit/io.h"
#include "garmentfit/mesh.h"
#include "garmentfit/skinned_gltf.h"
#include "glb_model.h"

namespace garmentfit {
namespace {

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

/// One 4 x 4 matrix a row, column by column as the format has them: from the world to the joint, whose axes are the
/// world's.
Eigen::Matrix<double, Eigen::Dynamic, 16, Eigen::RowMajor> inverse_binds(const std::vector<Joint>& joints)
{
    Eigen::Matrix<double, Eigen::Dynamic, 16, Eigen::RowMajor> rows(joints.size(), 16);
    for (std::size_t j = 0; j < joints.size(); ++j) {
        Eigen::Matrix4d joint_from_world = Eigen::Matrix4d::Identity();
        joint_from_world.topRightCorner<3, 1>() = -joints[j].place;
        rows.row(Eigen::Index(j)) = Eigen::Map<const Eigen::Matrix<double, 1, 16>>(joint_from_world.data());
    }
    return rows;
}

/// The body first, then the joints.
std::vector<tinygltf::Node> nodes_of(const std::vector<Joint>& joints)
{
    std::vector<tinygltf::Node> nodes(1 + joints.size());
    nodes[0].name = "body";
    nodes[0].mesh = 0;
    nodes[0].skin = 0;
    for (std::size_t j = 0; j < joints.size(); ++j) {
        const Joint& joint = joints[j];
        const Vec3 d = joint.parent < 0 ? joint.place : Vec3(joint.place - joints[std::size_t(joint.parent)].place);
        nodes[j + 1].name = joint.name;
        nodes[j + 1].translation = { d.x(), d.y(), d.z() };
        if (joint.parent >= 0)
            nodes[std::size_t(joint.parent) + 1].children.push_back(int(j) + 1);
    }
    return nodes;
}

tinygltf::Primitive primitive_of(const TriangleMesh& surface, const SkinWeights& weights, GlbModel& glb)
{
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    const int positions = glb.add<float>(surface.positions, TINYGLTF_TYPE_VEC3, TINYGLTF_TARGET_ARRAY_BUFFER);
    glb.set_bounds(positions, surface.positions);
    primitive.attributes["POSITION"] = positions;
    primitive.attributes["NORMAL"] = glb.add<float>(vertex_normals(surface.positions, surface.triangles),
                                                    TINYGLTF_TYPE_VEC3, TINYGLTF_TARGET_ARRAY_BUFFER);
    const Eigen::MatrixXi used = (weights.weights.array() > 0).select(weights.bones.array() + 1, 0);  // 0 where unused
    primitive.attributes["JOINTS_0"] = glb.add<std::uint8_t>(used, TINYGLTF_TYPE_VEC4, TINYGLTF_TARGET_ARRAY_BUFFER);
    primitive.attributes["WEIGHTS_0"]
        = glb.add<float>(weights.weights, TINYGLTF_TYPE_VEC4, TINYGLTF_TARGET_ARRAY_BUFFER);
    primitive.indices
        = glb.add<std::uint32_t>(surface.triangles, TINYGLTF_TYPE_SCALAR, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    return primitive;
}

}  // namespace

void write_skinned_glb(const std::filesystem::path& path, const TriangleMesh& surface, const Rig& rig)
{
    const std::vector<Joint> joints = joints_of(rig.skeleton);
    GlbModel glb;
    tinygltf::Mesh mesh;
    mesh.name = "body";
    mesh.primitives.push_back(primitive_of(surface, rig.weights, glb));
    glb.model.meshes.push_back(mesh);
    tinygltf::Skin skin;
    skin.skeleton = 1;
    skin.joints.resize(joints.size());
    std::iota(skin.joints.begin(), skin.joints.end(), 1);
    skin.inverseBindMatrices = glb.add<float>(inverse_binds(joints), TINYGLTF_TYPE_MAT4);
    glb.model.skins.push_back(skin);
    glb.model.nodes = nodes_of(joints);
    glb.model.scenes[0].nodes = { 0, 1 };
    write_file(path, glb.file());
}

}  // namespace garmentfit
