// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The Cholesky factor of a sparse, symmetric, positive definite matrix of 3 x 3 blocks.
//
// Method  multifrontal [duff_1983_multifrontal]: unknowns are eliminated in an order of approximate minimum degree
//         [amestoy_1996_amd]. Neighbouring columns whose entries lie in the same rows are one front, a dense matrix, which
//         takes what the fronts below it leave behind and hands its own remainder on. Fronts in different subtrees of the
//         elimination tree do not depend on each other and are computed side by side.
// Numbers blocks are in double precision, the factor and what is solved with it in single precision; the same bits for any
//         number of threads.

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "garmentfit/types.h"

namespace garmentfit {

class BlockCholesky {
public:
    /// Finds an order of elimination and the fronts.
    /// @param count  of block rows
    /// @param pairs  of different block rows that have a block
    BlockCholesky(int count, const std::vector<std::pair<int, int>>& pairs);

    void set_zero();
    /// All blocks, to set them back later.
    const std::vector<Eigen::Matrix3d>& blocks() const { return blocks_; }
    void set_blocks(const std::vector<Eigen::Matrix3d>& blocks) { blocks_ = blocks; }
    /// The block of rows i and columns j, and of j and i, which must be symmetric in itself; nullptr where there is none.
    Eigen::Matrix3d* find(int i, int j);

    /// Cost: on a surface of n vertices about n^1.5.
    /// @return whether the matrix is positive definite
    bool factorise();

    /// The solution of matrix * x = right, n x 3: three unknowns a row.
    Positions solve(const Positions& right) const;

private:
    using Dense = Eigen::MatrixXf;
    /// Columns that are eliminated together. Local rows are those of its columns, then `rows`.
    struct Front {
        int begin, end;  // columns, in the order of elimination
        std::vector<int> rows;  // below them, ascending
        std::vector<int> in_parent;  // for each of `rows` the local row of the parent
        std::vector<int> children;
        int left_begin;  // of what solve() hands to the parent, among that of all fronts

        int columns() const { return end - begin; }
        int size() const { return columns() + int(rows.size()); }
    };
    /// Fronts of a subtree, which are computed one after another, and those subtrees that do not wait for each other.
    using Subtree = std::pair<int, int>;

    void order(const std::vector<std::vector<int>>& neighbours);
    void find_fronts(const std::vector<std::vector<int>>& lower);
    void link_fronts();
    void plan_subtrees();
    void place_blocks(const std::vector<std::vector<int>>& lower);
    template <class Visit>
    void upwards(const Visit& visit) const;
    template <class Visit>
    void downwards(const Visit& visit) const;
    void take_blocks(const Front& front, Dense& factor) const;
    static void add_remainder(const Front& child, const Dense& left, const Front& front, Dense& factor,
                              Dense& remainder);
    bool eliminate(int f, std::vector<Dense>& left);

    std::vector<int> place_;  // of each row, in the order of elimination
    std::vector<Front> fronts_;  // children before parents
    int left_size_ = 0;  // of what all fronts hand to their parents
    std::vector<std::vector<Subtree>> levels_;

    // Blocks of the lower triangle, by column in the order of elimination.
    std::vector<int> block_begin_, block_rows_;
    std::vector<Eigen::Matrix3d> blocks_;
    std::vector<Dense> factors_;  // of each front: 3 size() x 3 columns()
};

}  // namespace garmentfit
