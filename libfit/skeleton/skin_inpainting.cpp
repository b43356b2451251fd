// SPDX-License-Identifier: GPL-3.0-or-later
#include "skin_inpainting.h"

#include <algorithm>
#include <limits>

#include <Eigen/SparseCholesky>

#include "cotangent_laplacian.h"
#include "garmentfit/error.h"

namespace garmentfit {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Entries = std::vector<Eigen::Triplet<double>>;

// unit: share of the mean area; the inverse of the area of a sliver would spoil the condition of the system.
constexpr double k_smallest_area = 1e-2;
// unit: a tie is this much stiffer than the cloth at a vertex, so that it holds to one part in a thousand.
constexpr double k_tie_stiffness = 1e3;

struct Smoothness {
    Matrix matrix;
    Eigen::VectorXd areas;  // of the vertices
};

Smoothness smoothness(const GarmentMesh& cloth, double stiff_length)
{
    const CotangentLaplacian laplacian = cotangent_laplacian({ cloth.positions, cloth.triangles });
    const double floor = std::max(k_smallest_area * laplacian.areas.mean(), std::numeric_limits<double>::min());
    const Eigen::VectorXd areas = laplacian.areas.cwiseMax(floor);
    const Eigen::VectorXd stiff = stiff_length * stiff_length * areas.cwiseInverse();
    return { laplacian.matrix + Matrix(laplacian.matrix * stiff.asDiagonal() * laplacian.matrix), areas };
}

/// Of each tie a row: the weights at its vertex less those at its foot.
Matrix differences(const std::vector<Tie>& ties, Eigen::Index vertices)
{
    Entries entries;
    for (std::size_t t = 0; t < ties.size(); ++t) {
        entries.emplace_back(int(t), ties[t].vertex, 1.0);
        for (int k = 0; k < 3; ++k)
            entries.emplace_back(int(t), ties[t].corners[k], -ties[t].weights[k]);
    }
    Matrix result(Eigen::Index(ties.size()), vertices);
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
}

}  // namespace

Eigen::MatrixXd inpaint(const GarmentMesh& cloth, const std::vector<Tie>& ties, const Eigen::VectorXd& pulls,
                        const Eigen::MatrixXd& targets, double stiff_length)
{
    auto [system, areas] = smoothness(cloth, stiff_length);
    if (!ties.empty()) {
        const Matrix tied = differences(ties, system.rows());
        const double stiffness = k_tie_stiffness * system.diagonal().mean();
        system += stiffness * Matrix(tied.transpose() * tied);
    }
    const Eigen::VectorXd drawn = areas.cwiseProduct(pulls);
    Matrix pulled(system.rows(), system.cols());
    pulled.reserve(Eigen::VectorXi::Constant(system.cols(), 1));
    for (int v = 0; v < int(drawn.size()); ++v)
        pulled.insert(v, v) = drawn[v];
    const Eigen::SimplicialLDLT<Matrix> solver(system + pulled);
    if (solver.info() != Eigen::Success)
        throw SolverFailure(
            "skin weights of cloth: the smoothest weights were not found; repair or remesh the garment");
    return solver.solve(drawn.asDiagonal() * targets);
}

}  // namespace garmentfit
