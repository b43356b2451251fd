// SPDX-License-Identifier: GPL-3.0-or-later
#include "layers.h"

#include <algorithm>

#include <QFileInfo>

#include <vcg/complex/algorithms/update/color.h>
#include <vcg/complex/append.h>

#include "garmentfit/filters/scene_arrays.h"

namespace garmentfit::meshlab {
namespace {

using Allocator = vcg::tri::Allocator<CMeshO>;

/// The row of each vertex of the layer; -1 for deleted ones.
std::vector<int> rows_of(const CMeshO& mesh)
{
    std::vector<int> rows;
    rows.reserve(mesh.vert.size());
    int next = 0;
    for (const CVertexO& vertex : mesh.vert)
        rows.push_back(vertex.IsD() ? -1 : next++);
    return rows;
}

Eigen::Matrix4d matrix_of(const CMeshO& mesh)
{
    Eigen::Matrix4d matrix;
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            matrix(row, column) = mesh.Tr.ElementAt(row, column);
    return matrix;
}

Vec3 vector_of(const CVertexO& vertex) { return { vertex.cP()[0], vertex.cP()[1], vertex.cP()[2] }; }

Point3m point_of(const Vec3& v) { return { Scalarm(v.x()), Scalarm(v.y()), Scalarm(v.z()) }; }

MeshModel& add_layer(MeshDocument& document, const std::string& name)
{
    return *document.addNewMesh("", QString::fromStdString(name), false);
}

}  // namespace

TriangleMesh mesh_of(const MeshModel& layer)
{
    const CMeshO& mesh = layer.cm;
    const std::vector<int> rows = rows_of(mesh);
    const Eigen::Matrix4d world_from_layer = matrix_of(mesh);
    TriangleMesh result { Positions(mesh.vn, 3), Triangles(mesh.fn, 3) };
    for (std::size_t v = 0; v < rows.size(); ++v)
        if (rows[v] >= 0)
            result.positions.row(rows[v]) = (world_from_layer * vector_of(mesh.vert[v]).homogeneous()).hnormalized();
    Eigen::Index f = 0;
    for (const CFaceO& face : mesh.face)
        if (!face.IsD()) {
            for (int corner = 0; corner < 3; ++corner)
                result.triangles(f, corner) = rows[face.cV(corner) - mesh.vert.data()];
            ++f;
        }
    return result;
}

CornerUvs corner_uvs_of(const MeshModel& layer)
{
    const CMeshO& mesh = layer.cm;
    const bool has_wedges = vcg::tri::HasPerWedgeTexCoord(mesh);
    if (!has_wedges && !vcg::tri::HasPerVertexTexCoord(mesh))
        return {};
    CornerUvs uvs(mesh.fn, 6);
    Eigen::Index f = 0;
    for (const CFaceO& face : mesh.face)
        if (!face.IsD()) {
            for (int corner = 0; corner < 3; ++corner) {
                const auto& uv = has_wedges ? face.cWT(corner) : face.cV(corner)->cT();
                uvs.row(f).segment<2>(2 * corner) << uv.u(), uv.v();
            }
            ++f;
        }
    return uvs;
}

std::vector<TriangleMesh> meshes_of(const std::vector<MeshModel*>& layers)
{
    std::vector<TriangleMesh> meshes;
    for (const MeshModel* layer : layers)
        meshes.push_back(mesh_of(*layer));
    return meshes;
}

std::string name_of(const MeshModel& layer)
{
    const QFileInfo label(layer.label());
    static const QStringList mesh_files { "obj", "ply", "off", "stl", "glb", "gltf", "3ds", "dae", "wrl", "x3d" };
    return (mesh_files.contains(label.suffix().toLower()) ? label.completeBaseName() : layer.label()).toStdString();
}

Positions as_kept(const Positions& positions)
{
    const Eigen::Matrix<Scalarm, Eigen::Dynamic, 3, Eigen::RowMajor> kept = positions.cast<Scalarm>();
    return kept.cast<double>();
}

MeshModel& add_moved_copy(MeshDocument& document, MeshModel& from, const std::string& name, const Positions& positions)
{
    MeshModel& layer = add_layer(document, name);
    layer.updateDataMask(&from);
    vcg::tri::Append<CMeshO, CMeshO>::MeshCopy(layer.cm, from.cm);
    copy_textures(from, layer);
    for (Eigen::Index v = 0; v < positions.rows(); ++v)
        layer.cm.vert[v].P() = point_of(positions.row(v));
    update_box_and_normals(layer);
    return layer;
}

MeshModel& add_skeleton(MeshDocument& document, const std::string& name, const Positions& joints)
{
    MeshModel& layer = add_layer(document, name);
    Allocator::AddVertices(layer.cm, joints.rows());
    for (Eigen::Index v = 0; v < joints.rows(); ++v)
        layer.cm.vert[v].P() = point_of(joints.row(v));
    for (const auto& [from, to] : skeleton_lines())
        Allocator::AddEdge(layer.cm, std::size_t(from), std::size_t(to));
    update_box_and_normals(layer);
    return layer;
}

void add_attribute(MeshModel& layer, const std::string& name, const Eigen::VectorXd& values)
{
    auto attribute = Allocator::GetPerVertexAttribute<Scalarm>(layer.cm, name);
    for (Eigen::Index v = 0; v < values.size(); ++v)
        attribute[std::size_t(v)] = Scalarm(values[v]);
}

void show_quality(MeshModel& layer, const Eigen::VectorXd& values, double red, double blue)
{
    layer.updateDataMask(MeshModel::MM_VERTQUALITY | MeshModel::MM_VERTCOLOR);
    for (Eigen::Index v = 0; v < values.size(); ++v) {
        CVertexO& vertex = layer.cm.vert[v];
        vertex.Q() = Scalarm(values[v]);
        vertex.C().SetColorRamp(float(red), float(blue), float(values[v]));
    }
}

}  // namespace garmentfit::meshlab
