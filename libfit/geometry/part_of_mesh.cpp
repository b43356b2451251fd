// SPDX-License-Identifier: GPL-3.0-or-later
#include "part_of_mesh.h"

#include <vector>

namespace garmentfit {

Box box_of(const Positions& positions)
{
    if (positions.rows() == 0)
        return {};
    return { Vec3(positions.colwise().minCoeff()), Vec3(positions.colwise().maxCoeff()) };
}

TriangleMesh part_in(const TriangleMesh& mesh, const Box& box)
{
    std::vector<int> rows;
    for (int f = 0; f < mesh.triangles.rows(); ++f) {
        Box of_triangle;
        for (const int v : mesh.triangles.row(f))
            of_triangle.extend(Vec3(mesh.positions.row(v)));
        if (of_triangle.intersects(box))
            rows.push_back(f);
    }
    return { mesh.positions, mesh.triangles(rows, Eigen::all) };
}

}  // namespace garmentfit
