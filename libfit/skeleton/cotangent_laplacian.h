// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCore>

#include "garmentfit/types.h"

namespace garmentfit {

struct CotangentLaplacian {
    Eigen::SparseMatrix<double> matrix;  ///< positive semi-definite; rows sum to 0
    Eigen::VectorXd areas;  ///< of each vertex: a third of its triangles
};

/// Cotangents of obtuse angles count as nearly 0, so that no entry beside the diagonal is positive and averages stay
/// between their sources. O(n).
CotangentLaplacian cotangent_laplacian(const TriangleMesh& mesh);

}  // namespace garmentfit
