// SPDX-License-Identifier: GPL-3.0-or-later
#include "glb_skinned_mesh.h"

#include <algorithm>
#include <limits>
#include <map>
#include <string>

#include "garmentfit/mesh.h"
#include "glb_appearance.h"

namespace garmentfit {
namespace {

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
tinygltf::Primitive attributes_of(const SkinnedMesh& mesh, const FileWeights& skin, const SeamVertices& vertices,
                                  GlbModel& glb)
{
    const std::vector<int>& rows = vertices.sources;
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    const auto add = [&](const std::string& name, const auto& values, int type, auto number) {
        primitive.attributes[name] = glb.add<decltype(number)>(values, type, TINYGLTF_TARGET_ARRAY_BUFFER);
    };
    add("POSITION", mesh.surface.positions(rows, Eigen::all), TINYGLTF_TYPE_VEC3, float());
    glb.set_bounds(primitive.attributes["POSITION"], mesh.surface.positions);
    add("NORMAL", unit_normals(mesh.surface)(rows, Eigen::all), TINYGLTF_TYPE_VEC3, float());
    if (vertices.uvs.rows() > 0)
        add("TEXCOORD_0", vertices.uvs, TINYGLTF_TYPE_VEC2, float());
    const bool has_many = skin.joints.size() > 0 && skin.joints.maxCoeff() > std::numeric_limits<std::uint8_t>::max();
    for (int set = 0; 4 * set < int(skin.joints.cols()); ++set) {
        const std::string joints = "JOINTS_" + std::to_string(set), weights = "WEIGHTS_" + std::to_string(set);
        const auto four = Eigen::seqN(4 * set, 4);
        if (has_many)
            add(joints, skin.joints(rows, four), TINYGLTF_TYPE_VEC4, std::uint16_t());
        else
            add(joints, skin.joints(rows, four), TINYGLTF_TYPE_VEC4, std::uint8_t());
        add(weights, skin.weights(rows, four), TINYGLTF_TYPE_VEC4, float());
    }
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

}  // namespace

tinygltf::Mesh gltf_mesh(const SkinnedMesh& mesh, const FileWeights& weights, GlbModel& glb)
{
    const SeamVertices vertices = split_at_seams(mesh.surface.positions.rows(), mesh.surface.triangles, mesh.look);
    const tinygltf::Primitive attributes = attributes_of(mesh, weights, vertices, glb);
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

}  // namespace garmentfit
