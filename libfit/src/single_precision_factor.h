// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A sparse Cholesky factor that solves for three right sides at once, in single precision: a preconditioner.
//
// The triangular solves are bound by the memory that the factor takes. One pass for x, y and z together, at half the bytes, takes a
// third of the time of three passes in double precision; conjugate gradients in double precision mend the digits.

#include <Eigen/SparseCholesky>
#include <vector>

#include "fit/types.h"

namespace fit {

class SinglePrecisionFactor {
public:
    /// @param system  symmetric and positive definite, both triangles stored; always of the same pattern
    /// @return whether it could be factorised (in double precision)
    bool compute(const Eigen::SparseMatrix<double>& system);

    /// About the solution of system * x = right, n x 3.
    Positions solve(const Positions& right) const;

private:
    Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> cholesky_;
    std::vector<float> below_;  // the factor's values below its diagonal, column by column
    std::vector<float> inverse_diagonal_;
    bool analysed_ = false;
};

}  // namespace fit
