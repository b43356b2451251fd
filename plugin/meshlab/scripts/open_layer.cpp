// SPDX-License-Identifier: GPL-3.0-or-later
#include "open_layer.h"

#include "garmentfit/io.h"

namespace garmentfit::meshlab {

MeshModel& add_mesh(MeshDocument& document, const std::filesystem::path& path, const TriangleMesh& mesh)
{
    using Allocator = vcg::tri::Allocator<CMeshO>;
    MeshModel& layer = *document.addNewMesh(QString::fromStdString(path.string()), "", document.size() == 0);
    Allocator::AddVertices(layer.cm, mesh.positions.rows());
    for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v)
        for (int axis = 0; axis < 3; ++axis)
            layer.cm.vert[v].P()[axis] = Scalarm(mesh.positions(v, axis));
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
        Allocator::AddFace(layer.cm, mesh.triangles(f, 0), mesh.triangles(f, 1), mesh.triangles(f, 2));
    update_box_and_normals(layer);
    return layer;
}

MeshModel& open_layer(MeshDocument& document, const std::filesystem::path& path)
{
    const MeshFile file = MeshFile::read(path);
    return add_mesh(document, path, { file.positions(), file.triangles() });
}

}  // namespace garmentfit::meshlab
