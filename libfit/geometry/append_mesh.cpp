// SPDX-License-Identifier: GPL-3.0-or-later
#include "append_mesh.h"

namespace garmentfit {

void append(TriangleMesh& mesh, const TriangleMesh& more)
{
    const Eigen::Index vertices = mesh.positions.rows(), triangles = mesh.triangles.rows();
    mesh.positions.conservativeResize(vertices + more.positions.rows(), 3);
    mesh.positions.bottomRows(more.positions.rows()) = more.positions;
    mesh.triangles.conservativeResize(triangles + more.triangles.rows(), 3);
    mesh.triangles.bottomRows(more.triangles.rows()) = (more.triangles.array() + int(vertices)).matrix();
}

}  // namespace garmentfit
