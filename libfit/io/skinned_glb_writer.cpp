// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "garmentfit/error.h"
#include "garmentfit/io.h"
#include "garmentfit/mesh.h"
#include "garmentfit/skinned_gltf.h"
#include "glb_appearance.h"
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

/// Attributes of all vertices, which the primitives of a mesh share.
tinygltf::Primitive attributes_of(const SkinnedMesh& mesh, const SeamVertices& vertices, GlbModel& glb)
{
    const std::vector<int>& rows = vertices.sources;
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    const auto add = [&](const char* name, const auto& values, int type, auto number) {
        primitive.attributes[name] = glb.add<decltype(number)>(values, type, TINYGLTF_TARGET_ARRAY_BUFFER);
    };
    add("POSITION", mesh.surface.positions(rows, Eigen::all), TINYGLTF_TYPE_VEC3, float());
    glb.set_bounds(primitive.attributes["POSITION"], mesh.surface.positions);
    add("NORMAL", unit_normals(mesh.surface)(rows, Eigen::all), TINYGLTF_TYPE_VEC3, float());
    if (vertices.uvs.rows() > 0)
        add("TEXCOORD_0", vertices.uvs, TINYGLTF_TYPE_VEC2, float());
    const SkinWeights& skin = mesh.weights;
    const Eigen::MatrixXi used = (skin.weights.array() > 0).select(skin.bones.array() + 1, 0);  // 0 where unused
    add("JOINTS_0", used(rows, Eigen::all), TINYGLTF_TYPE_VEC4, std::uint8_t());
    add("WEIGHTS_0", skin.weights(rows, Eigen::all), TINYGLTF_TYPE_VEC4, float());
    if (!mesh.covered.empty()) {
        Eigen::VectorXd mask(Eigen::Index(rows.size()));
        for (std::size_t v = 0; v < rows.size(); ++v)
            mask[Eigen::Index(v)] = mesh.covered[std::size_t(rows[v])];
        add("_COVERED", mask, TINYGLTF_TYPE_SCALAR, float());
    }
    return primitive;
}

bool is_hidden(const SkinnedMesh& mesh, Eigen::Index triangle)
{
    const auto corners = mesh.surface.triangles.row(triangle);
    return mesh.hides_covered && !mesh.covered.empty()
        && std::all_of(corners.begin(), corners.end(), [&](int v) { return mesh.covered[std::size_t(v)]; });
}

/// Rows of the triangles of each material, -1: none. All of them where all are hidden: glTF knows no empty mesh.
std::map<int, std::vector<Eigen::Index>> triangles_by_material(const SkinnedMesh& mesh)
{
    std::map<int, std::vector<Eigen::Index>> shown, all;
    const bool has_materials = Eigen::Index(mesh.look.material_of.size()) == mesh.surface.triangles.rows();
    for (Eigen::Index f = 0; f < mesh.surface.triangles.rows(); ++f) {
        const int material = has_materials ? mesh.look.material_of[std::size_t(f)] : -1;
        all[material].push_back(f);
        if (!is_hidden(mesh, f))
            shown[material].push_back(f);
    }
    return shown.empty() ? all : shown;
}

tinygltf::Mesh gltf_mesh(const SkinnedMesh& mesh, GlbModel& glb)
{
    const SeamVertices vertices = split_at_seams(mesh.surface.positions.rows(), mesh.surface.triangles, mesh.look);
    const tinygltf::Primitive attributes = attributes_of(mesh, vertices, glb);
    const int first_material = add_materials(mesh.look, glb);
    tinygltf::Mesh result;
    result.name = mesh.name;
    for (const auto& [material, rows] : triangles_by_material(mesh)) {
        tinygltf::Primitive primitive = attributes;
        const Triangles own = vertices.triangles(rows, Eigen::all);
        primitive.indices = glb.add<std::uint32_t>(own, TINYGLTF_TYPE_SCALAR, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
        if (material >= 0)
            primitive.material = first_material + material;
        result.primitives.push_back(primitive);
    }
    return result;
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
    for (const SkinnedMesh& mesh : meshes) {
        glb.model.scenes[0].nodes.push_back(int(glb.model.meshes.size()));
        glb.model.meshes.push_back(gltf_mesh(mesh, glb));
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
