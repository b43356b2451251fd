// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface_measures.h"

#include <Eigen/Eigenvalues>

namespace garmentfit {

double diagonal(const Positions& positions)
{
    return (positions.colwise().maxCoeff() - positions.colwise().minCoeff()).norm();
}

Vec3 squared_extents(const Positions& points)
{
    const Positions arms = points.rowwise() - points.colwise().mean();
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(arms.transpose() * arms, Eigen::EigenvaluesOnly)
        .eigenvalues();
}

bool is_flat(const Positions& points, double share)
{
    const Vec3 squares = squared_extents(points);
    return squares[0] <= share * share * squares[2];
}

double area(const TriangleMesh& mesh)
{
    double sum = 0;
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
        sum += area_vector(mesh.positions, mesh.triangles, f).norm();
    return sum;
}

double area(const std::vector<Vec3>& area_vectors, const std::vector<int>& faces)
{
    double sum = 0;
    for (const int f : faces)
        sum += area_vectors[f].norm();
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
