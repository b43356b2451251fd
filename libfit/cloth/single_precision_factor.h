// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A sparse Cholesky factor that solves for three right sides at once, in single precision, on all threads: a preconditioner.
//
// The triangular solves are bound by the memory that the factor takes. One pass for x, y and z together, at half the bytes, takes a
// third of the time of three passes in double precision; conjugate gradients in double precision mend the digits.
//
// Unknowns that do not meet in the elimination tree can be solved for side by side: the columns are put into an order of
// disjoint subtrees, the branches, and of what stands above them all, the stem.

#include <Eigen/SparseCholesky>
#include <array>
#include <vector>

#include "garmentfit/types.h"

namespace garmentfit {

class SinglePrecisionFactor {
public:
    /// @param system  symmetric and positive definite, both triangles stored; always of the same pattern
    /// @return whether it could be factorised (in double precision)
    bool compute(const Eigen::SparseMatrix<double>& system);

    /// About the solution of system * x = right, n x 3. Same bits for any number of threads.
    Positions solve(const Positions& right) const;

private:
    using Quads = std::vector<Eigen::Vector4f>;  // of four, so that each is one register

    void divide();
    void copy_values();
    void forward(Quads& x, int begin, int end, Eigen::Vector4f* stem) const;
    void backward(Quads& x, int begin, int end) const;

    Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> cholesky_;
    bool analysed_ = false;

    // The factor in the order of branches and stem; the rows of a column that belong to the stem come last.
    std::vector<int> branch_begin_;  // the last one is where the stem begins
    std::vector<int> columns_;  // of the factor as computed
    std::vector<int> place_;  // of each unknown of the system
    std::vector<int> begin_, stem_entries_;  // of each column
    std::vector<int> entries_;  // of the factor as computed
    std::vector<int> rows_;
    std::vector<float> below_, inverse_diagonal_;
};

}  // namespace garmentfit
