// SPDX-License-Identifier: GPL-3.0-or-later
#include "cotangent_laplacian.h"

#include <algorithm>
#include <vector>

namespace garmentfit {
namespace {

constexpr double k_smallest_cotangent = 1e-3;  // unit: keeps the matrix positive definite with obtuse triangles
constexpr double k_largest_cotangent = 1e6;  // unit: keeps it finite, and solvable, with triangles without area
constexpr double k_no_length = 1e-300;  // unit: avoids 0 / 0

}  // namespace

CotangentLaplacian cotangent_laplacian(const TriangleMesh& mesh)
{
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd areas = Eigen::VectorXd::Zero(mesh.positions.rows());
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int i = mesh.triangles(f, k), j = mesh.triangles(f, (k + 1) % 3), o = mesh.triangles(f, (k + 2) % 3);
            const Vec3 a = mesh.positions.row(i) - mesh.positions.row(o),
                       b = mesh.positions.row(j) - mesh.positions.row(o);
            const double twice_area = a.cross(b).norm();
            const double half_cotangent = 0.5
                * std::clamp(a.dot(b) / std::max(twice_area, k_no_length), k_smallest_cotangent, k_largest_cotangent);
            areas[o] += twice_area / 6;  // derived: a third of the triangle
            entries.emplace_back(i, i, half_cotangent);
            entries.emplace_back(j, j, half_cotangent);
            entries.emplace_back(i, j, -half_cotangent);
            entries.emplace_back(j, i, -half_cotangent);
        }
    Eigen::SparseMatrix<double> matrix(mesh.positions.rows(), mesh.positions.rows());
    matrix.setFromTriplets(entries.begin(), entries.end());
    return { std::move(matrix), std::move(areas) };
}

}  // namespace garmentfit
