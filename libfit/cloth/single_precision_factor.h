// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A sparse Cholesky factor that solves for three right sides at once, in single precision, on all threads: a
// preconditioner.
//
// The triangular solves are bound by the memory that the factor takes. One pass for x, y and z together, at half the
// bytes, takes a third of the time of three passes in double precision. Conjugate gradients in double precision make up
// for the lost digits.
//
// Unknowns in different subtrees of the elimination tree do not depend on each other. The columns are ordered as
// disjoint subtrees, the branches, which are solved in parallel, and the stem, which holds all columns above them.

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

    /// Approximately the solution of system * x = right, n x 3. Same bits for any number of threads.
    Positions solve(const Positions& right) const;

private:
    using Quads = std::vector<Eigen::Vector4f>;  // of four, so that each fits one register

    void order_columns(const std::vector<int>& branch);
    void order_entries(const std::vector<int>& branch);
    void copy_values();
    void forward(Quads& x, int begin, int end, Eigen::Vector4f* stem) const;
    void backward(Quads& x, int begin, int end) const;

    Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> cholesky_;
    bool analysed_ = false;

    // The factor in the order of branches and stem. In each column the rows that belong to the stem come last.
    std::vector<int> branch_begin_;  // first column of each branch, then that of the stem
    std::vector<int> columns_;  // of the computed factor, in the new order
    std::vector<int> new_index_;  // of each column of the computed factor
    std::vector<int> place_;  // of each unknown of the system, in the new order
    std::vector<int> begin_, stem_entries_;  // of each column: its first entry, and the first one in the stem's rows
    std::vector<int> entries_;  // of the computed factor, in the new order
    std::vector<int> rows_;
    std::vector<float> below_, inverse_diagonal_;
};

}  // namespace garmentfit
