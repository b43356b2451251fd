// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <numeric>
#include <string>
#include <vector>

#include "garmentfit/error.h"
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

/// The meshes first, then the joints.
std::vector<tinygltf::Node> nodes_of(const std::vector<SkinnedMesh>& meshes, const std::vector<Joint>& joints)
{
    std::vector<tinygltf::Node> nodes(meshes.size() + joints.size());
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        nodes[m].name = meshes[m].name;
        nodes[m].mesh = int(m);
        nodes[m].skin = 0;
    }
    for (std::size_t j = 0; j < joints.size(); ++j) {
        const Joint& joint = joints[j];
        const Vec3 d = joint.parent < 0 ? joint.place : Vec3(joint.place - joints[std::size_t(joint.parent)].place);
        nodes[meshes.size() + j].name = joint.name;
        nodes[meshes.size() + j].translation = { d.x(), d.y(), d.z() };
        if (joint.parent >= 0)
            nodes[meshes.size() + std::size_t(joint.parent)].children.push_back(int(meshes.size() + j));
    }
    return nodes;
}

/// The format wants unit normals, also where a vertex has no face.
Positions unit_normals(const TriangleMesh& surface)
{
    Positions normals = vertex_normals(surface.positions, surface.triangles);
    for (auto normal : normals.rowwise())
        if (!(normal.squaredNorm() > 0))
            normal = Eigen::RowVector3d::UnitY();
    return normals;
}

tinygltf::Primitive primitive_of(const SkinnedMesh& mesh, GlbModel& glb)
{
    const auto& [name, surface, weights, covered] = mesh;
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    const int positions = glb.add<float>(surface.positions, TINYGLTF_TYPE_VEC3, TINYGLTF_TARGET_ARRAY_BUFFER);
    glb.set_bounds(positions, surface.positions);
    primitive.attributes["POSITION"] = positions;
    primitive.attributes["NORMAL"]
        = glb.add<float>(unit_normals(surface), TINYGLTF_TYPE_VEC3, TINYGLTF_TARGET_ARRAY_BUFFER);
    const Eigen::MatrixXi used = (weights.weights.array() > 0).select(weights.bones.array() + 1, 0);  // 0 where unused
    primitive.attributes["JOINTS_0"] = glb.add<std::uint8_t>(used, TINYGLTF_TYPE_VEC4, TINYGLTF_TARGET_ARRAY_BUFFER);
    primitive.attributes["WEIGHTS_0"]
        = glb.add<float>(weights.weights, TINYGLTF_TYPE_VEC4, TINYGLTF_TARGET_ARRAY_BUFFER);
    if (!covered.empty()) {
        const auto mask = Eigen::Map<const Eigen::Matrix<char, Eigen::Dynamic, 1>>(covered.data(), covered.size());
        primitive.attributes["_COVERED"] = glb.add<float>(mask, TINYGLTF_TYPE_SCALAR, TINYGLTF_TARGET_ARRAY_BUFFER);
    }
    primitive.indices
        = glb.add<std::uint32_t>(surface.triangles, TINYGLTF_TYPE_SCALAR, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    return primitive;
}

}  // namespace

void write_skinned_glb(const std::filesystem::path& path, const Skeleton& skeleton,
                       const std::vector<SkinnedMesh>& meshes)
{
    for (const SkinnedMesh& mesh : meshes)
        if (mesh.weights.weights.rows() != mesh.surface.positions.rows())
            throw InvalidInput(ErrorCode::count_mismatch,
                               "skinned GLB: " + mesh.name + " has " + std::to_string(mesh.surface.positions.rows())
                                   + " vertices and " + std::to_string(mesh.weights.weights.rows())
                                   + " rows of weights; give a row for each vertex");
    const std::vector<Joint> joints = joints_of(skeleton);
    GlbModel glb;
    for (const SkinnedMesh& skinned : meshes) {
        tinygltf::Mesh mesh;
        mesh.name = skinned.name;
        mesh.primitives.push_back(primitive_of(skinned, glb));
        glb.model.scenes[0].nodes.push_back(int(glb.model.meshes.size()));
        glb.model.meshes.push_back(mesh);
    }
    tinygltf::Skin skin;
    skin.skeleton = int(meshes.size());  // the node of the root
    skin.joints.resize(joints.size());
    std::iota(skin.joints.begin(), skin.joints.end(), skin.skeleton);
    skin.inverseBindMatrices = glb.add<float>(inverse_binds(joints), TINYGLTF_TYPE_MAT4);
    glb.model.skins.push_back(skin);
    glb.model.nodes = nodes_of(meshes, joints);
    glb.model.scenes[0].nodes.push_back(skin.skeleton);
    write_file(path, glb.file());
}

void write_skinned_glb(const std::filesystem::path& path, const TriangleMesh& surface, const Rig& rig)
{
    write_skinned_glb(path, rig.skeleton, { { "body", surface, rig.weights } });
}

}  // namespace garmentfit
