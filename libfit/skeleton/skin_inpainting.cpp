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

Matrix smoothness(const GarmentMesh& cloth, double stiff_length)
{
    const CotangentLaplacian laplacian = cotangent_laplacian({ cloth.positions, cloth.triangles });
    const double floor = std::max(k_smallest_area * laplacian.areas.mean(), std::numeric_limits<double>::min());
    const Eigen::VectorXd stiff = stiff_length * stiff_length * laplacian.areas.cwiseMax(floor).cwiseInverse();
    return laplacian.matrix + Matrix(laplacian.matrix * stiff.asDiagonal() * laplacian.matrix);
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

/// The rows of the unknown vertices of a symmetric system, split into unknown and known columns.
struct Split {
    Matrix unknown, known;
};

Split split(const Matrix& system, const std::vector<char>& is_known, const std::vector<int>& row_of, int unknown)
{
    Entries of_unknown, of_known;
    for (int column = 0; column < system.outerSize(); ++column)
        for (Matrix::InnerIterator entry(system, column); entry; ++entry)
            if (!is_known[std::size_t(entry.row())])
                (is_known[std::size_t(column)] ? of_known : of_unknown)
                    .emplace_back(row_of[std::size_t(entry.row())], row_of[std::size_t(column)], entry.value());
    Split result { Matrix(unknown, unknown), Matrix(unknown, system.cols() - unknown) };
    result.unknown.setFromTriplets(of_unknown.begin(), of_unknown.end());
    result.known.setFromTriplets(of_known.begin(), of_known.end());
    return result;
}

}  // namespace

void inpaint(const GarmentMesh& cloth, const std::vector<Tie>& ties, const std::vector<char>& is_known,
             double stiff_length, Eigen::MatrixXd& weights)
{
    std::vector<int> known, unknown, row_of(is_known.size());
    for (int v = 0; v < int(is_known.size()); ++v) {
        std::vector<int>& list = is_known[std::size_t(v)] ? known : unknown;
        row_of[std::size_t(v)] = int(list.size());
        list.push_back(v);
    }
    if (unknown.empty())
        return;
    Matrix system = smoothness(cloth, stiff_length);
    if (!ties.empty()) {
        const Matrix tied = differences(ties, system.rows());
        const double stiffness = k_tie_stiffness * system.diagonal().mean();
        system += stiffness * Matrix(tied.transpose() * tied);
    }
    const Split parts = split(system, is_known, row_of, int(unknown.size()));
    const Eigen::SimplicialLDLT<Matrix> solver(parts.unknown);
    if (solver.info() != Eigen::Success)
        throw SolverFailure(
            "skin weights of cloth: the smoothest weights were not found; repair or remesh the garment");
    const Eigen::MatrixXd from_known = parts.known * Eigen::MatrixXd(weights(known, Eigen::all));
    const Eigen::MatrixXd solved = solver.solve(-from_known);  // the solver cannot write to chosen rows
    weights(unknown, Eigen::all) = solved;
}

}  // namespace garmentfit
