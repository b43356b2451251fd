// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface_measures.h"

#include <Eigen/Geometry>

namespace garmentfit {

double area(const TriangleMesh& mesh)
{
    double sum = 0;
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
        const Vec3 a = mesh.positions.row(mesh.triangles(f, 0)), b = mesh.positions.row(mesh.triangles(f, 1)),
                   c = mesh.positions.row(mesh.triangles(f, 2));
        sum += 0.5 * (b - a).cross(c - a).norm();
    }
    return sum;
}

double volume(const TriangleMesh& closed)
{
    const Vec3 origin = closed.positions.row(0);  // near by, to keep digits
    double sum = 0;
    for (Eigen::Index f = 0; f < closed.triangles.rows(); ++f) {
        const auto corner
            = [&](int k) { return Vec3(closed.positions.row(closed.triangles(f, k)).transpose() - origin); };
        sum += corner(0).cross(corner(1)).dot(corner(2)) / 6;
    }
    return sum;
}

}  // namespace garmentfit
