// SPDX-License-Identifier: GPL-3.0-or-later
#include "append_mesh.h"

#include <utility>

namespace garmentfit {

namespace {

template <class Mesh>
void append_triangles(Mesh& mesh, const Mesh& more)
{
    const Eigen::Index vertices = mesh.positions.rows(), triangles = mesh.triangles.rows();
    mesh.positions.conservativeResize(vertices + more.positions.rows(), 3);
    mesh.positions.bottomRows(more.positions.rows()) = more.positions;
    mesh.triangles.conservativeResize(triangles + more.triangles.rows(), 3);
    mesh.triangles.bottomRows(more.triangles.rows()) = (more.triangles.array() + int(vertices)).matrix();
}

}  // namespace

void append(TriangleMesh& mesh, const TriangleMesh& more) { append_triangles(mesh, more); }

void append(GarmentMesh& mesh, const GarmentMesh& more)
{
    const Eigen::Index before = mesh.triangles.rows();
    append_triangles(mesh, more);
    if (mesh.warps.rows() == 0 && more.warps.rows() == 0)
        return;
    const Warps warps = std::exchange(mesh.warps, Warps::Zero(mesh.triangles.rows(), 2));
    mesh.warps.topRows(warps.rows()) = warps;
    mesh.warps.middleRows(before, more.warps.rows()) = more.warps;
}

}  // namespace garmentfit
