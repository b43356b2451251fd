// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <numeric>
#include <string>
#include <vector>

#include "garmentfit/error.h"
#include "garmentfit/io.h"
#include "garmentfit/skinned_gltf.h"
#include "glb_skinned_mesh.h"
#include "keyframes.h"

namespace garmentfit {
namespace {

/// What the joints are on their way into the file.
struct Bones {
    const Skeleton& skeleton;
    JointTree tree;
    std::vector<Eigen::Quaterniond> turns;  ///< of each joint, relative to its parent: the pose that is shown
};

Bones bones_at_rest(const Skeleton& skeleton, BoneNames names)
{
    Bones bones { skeleton, joint_tree(skeleton, names), {} };
    bones.turns.assign(bones.tree.joints.size(), Eigen::Quaterniond::Identity());
    return bones;
}

/// As VRM 1.0 wants models: in T pose, facing +z.
Bones bones_in_t_pose(const Rig& rig, BoneNames names)
{
    Bones bones = bones_at_rest(rig.skeleton, names);
    for (const Keyframe& key : keyframes_of(rig))
        if (key.name == k_t_pose)
            for (std::size_t j = 0; j < bones.turns.size(); ++j)
                if (const int bone = bones.tree.joints[j].bone; bone >= 0 && bone < bone_count)
                    bones.turns[j] = key.pose.rotations[std::size_t(bone)];
    Eigen::Matrix3d body_axes;
    body_axes.row(1) = rig.up.normalized();
    body_axes.row(0) = rig.up.cross(rig.front).normalized();
    body_axes.row(2) = body_axes.row(0).cross(body_axes.row(1));
    bones.turns[0] = Eigen::Quaterniond(body_axes);
    return bones;
}

/// One 4 x 4 matrix a row, column by column as the format has them: from the world to the joint, whose axes are the
/// world's.
Eigen::Matrix<double, Eigen::Dynamic, 16, Eigen::RowMajor> inverse_binds(const std::vector<FileJoint>& joints)
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
std::vector<tinygltf::Node> nodes_of(const std::vector<SkinnedMesh>& meshes, const Bones& bones)
{
    const std::vector<FileJoint>& joints = bones.tree.joints;
    std::vector<tinygltf::Node> nodes(meshes.size() + joints.size());
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        nodes[m].name = meshes[m].name;
        nodes[m].mesh = int(m);
        nodes[m].skin = 0;
    }
    for (std::size_t j = 0; j < joints.size(); ++j) {
        const FileJoint& joint = joints[j];
        tinygltf::Node& node = nodes[meshes.size() + j];
        const Vec3 d = joint.parent < 0 ? joint.place : Vec3(joint.place - joints[std::size_t(joint.parent)].place);
        node.name = joint.name;
        node.translation = { d.x(), d.y(), d.z() };
        if (const Eigen::Quaterniond turn = bones.turns[j].normalized(); turn.vec().norm() > 0)
            node.rotation = { turn.x(), turn.y(), turn.z(), turn.w() };
        if (joint.parent >= 0)
            nodes[meshes.size() + std::size_t(joint.parent)].children.push_back(int(meshes.size() + j));
    }
    return nodes;
}

JointWeights weights_of(const SkinnedMesh& mesh)
{
    const bool has_more = mesh.more_weights.rows() > 0;
    const Eigen::Index rows = has_more ? mesh.more_weights.rows() : mesh.weights.weights.rows(),
                       bones = has_more ? mesh.more_weights.cols() : Eigen::Index(bone_count);
    if (rows != mesh.surface.positions.rows() || bones != bone_count)
        throw InvalidInput(ErrorCode::count_mismatch,
                           "skinned GLB: " + mesh.name + " has " + std::to_string(mesh.surface.positions.rows())
                               + " vertices and weights of " + std::to_string(rows) + " over " + std::to_string(bones)
                               + " bones; give a row for each vertex and a column for each bone");
    return has_more ? mesh.more_weights : joint_weights_of(mesh.weights);
}

GlbModel skinned_model(const Bones& bones, const std::vector<SkinnedMesh>& meshes)
{
    GlbModel glb;
    for (const SkinnedMesh& mesh : meshes) {
        glb.model.scenes[0].nodes.push_back(int(glb.model.meshes.size()));
        glb.model.meshes.push_back(
            gltf_mesh(mesh, file_weights(bones.tree, bones.skeleton, mesh.surface.positions, weights_of(mesh)), glb));
    }
    tinygltf::Skin skin;
    skin.skeleton = int(meshes.size());  // the node of the root
    skin.joints.resize(bones.tree.joints.size());
    std::iota(skin.joints.begin(), skin.joints.end(), skin.skeleton);
    skin.inverseBindMatrices = glb.add<float>(inverse_binds(bones.tree.joints), TINYGLTF_TYPE_MAT4);
    glb.model.skins.push_back(skin);
    glb.model.nodes = nodes_of(meshes, bones);
    glb.model.scenes[0].nodes.push_back(skin.skeleton);
    return glb;
}

using Object = tinygltf::Value::Object;

/// Who made an avatar and what others may do with it is not known here: the strictest choices, which are the defaults.
Object vrm_meta(const std::string& title)
{
    return { { "name", tinygltf::Value(title) },
             { "authors", tinygltf::Value(tinygltf::Value::Array { tinygltf::Value(std::string("unknown")) }) },
             { "licenseUrl", tinygltf::Value(std::string("https://vrm.dev/licenses/1.0/")) } };
}

void add_vrm(GlbModel& glb, const Bones& bones, const std::string& title)
{
    Object human_bones;
    const int first = glb.model.skins[0].skeleton;
    for (std::size_t j = 0; j < bones.tree.joints.size(); ++j)
        human_bones[bones.tree.joints[j].name]
            = tinygltf::Value(Object { { "node", tinygltf::Value(first + int(j)) } });
    const Object humanoid { { "humanBones", tinygltf::Value(human_bones) } };
    glb.model.extensions["VRMC_vrm"] = tinygltf::Value(Object { { "specVersion", tinygltf::Value(std::string("1.0")) },
                                                                { "meta", tinygltf::Value(vrm_meta(title)) },
                                                                { "humanoid", tinygltf::Value(humanoid) } });
    glb.model.extensionsUsed.push_back("VRMC_vrm");
}

}  // namespace

void write_skinned_glb(const std::filesystem::path& path, const Skeleton& skeleton,
                       const std::vector<SkinnedMesh>& meshes)
{
    write_file(path, skinned_model(bones_at_rest(skeleton, BoneNames::garmentfit), meshes).file());
}

void write_skinned_glb(const std::filesystem::path& path, const TriangleMesh& surface, const Rig& rig)
{
    write_skinned_glb(path, rig.skeleton, { { "body", surface, rig.weights } });
}

void write_outfit_glb(const std::filesystem::path& path, const Rig& rig, const std::vector<SkinnedMesh>& meshes,
                      const OutfitOptions& options)
{
    const bool is_vrm = options.names == BoneNames::vrm;
    const Bones bones = is_vrm ? bones_in_t_pose(rig, options.names) : bones_at_rest(rig.skeleton, options.names);
    GlbModel glb = skinned_model(bones, meshes);
    if (is_vrm)
        add_vrm(glb, bones, options.title);
    write_file(path, glb.file());
}

}  // namespace garmentfit
