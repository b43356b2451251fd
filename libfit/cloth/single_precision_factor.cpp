// SPDX-License-Identifier: GPL-3.0-or-later
#include "single_precision_factor.h"

#include <algorithm>
#include <numeric>
#include <queue>

#include "parallel.h"
#include "tuning.h"

namespace garmentfit {
namespace {

constexpr int k_stem = k_factor_branches;  // derived: the index of the stem, after the branches

/// The elimination tree of a factor: a column's parent is the first row below its diagonal.
struct EliminationTree {
    std::vector<int> parent;  // -1: none
    std::vector<long> work;  // entries of the factor in the subtree

    template <class Factor>
    explicit EliminationTree(const Factor& factor) : parent(factor.cols(), -1), work(factor.cols())
    {
        const int* begin = factor.outerIndexPtr();
        for (int j = 0; j < int(parent.size()); ++j) {
            work[j] += begin[j + 1] - begin[j];
            if (begin[j + 1] - begin[j] > 1) {
                parent[j] = factor.innerIndexPtr()[begin[j] + 1];
                work[parent[j]] += work[j];
            }
        }
    }
};

/// For each column its branch, or k_stem. Subtrees are split from the top until each is a small part of the work. Then
/// they are dealt out, the largest first, each to the branch with the least work.
std::vector<int> assign_branches(const EliminationTree& tree)
{
    const int n = int(tree.parent.size());
    std::vector<std::vector<int>> children(n);
    using Subtree = std::pair<long, int>;  // work, root
    std::priority_queue<Subtree> subtrees;
    long all = 0;
    for (int j = 0; j < n; ++j)
        if (tree.parent[j] >= 0)
            children[tree.parent[j]].push_back(j);
        else
            subtrees.emplace(tree.work[j], j), all += tree.work[j];
    std::vector<int> result(n, -1);
    while (!subtrees.empty() && subtrees.top().first > all / (k_subtrees_per_branch * k_factor_branches)) {
        const int root = subtrees.top().second;
        subtrees.pop();
        result[root] = k_stem;
        for (const int child : children[root])
            subtrees.emplace(tree.work[child], child);
    }
    std::array<long, k_factor_branches> load {};
    for (; !subtrees.empty(); subtrees.pop()) {
        const auto least = std::min_element(load.begin(), load.end());
        result[subtrees.top().second] = int(least - load.begin());
        *least += subtrees.top().first;
    }
    for (int j = n - 1; j >= 0; --j)
        if (result[j] < 0)
            result[j] = result[tree.parent[j]];
    return result;
}

}  // namespace

bool SinglePrecisionFactor::compute(const Eigen::SparseMatrix<double>& system)
{
    if (!analysed_)
        cholesky_.analyzePattern(system);
    cholesky_.factorize(system);
    if (cholesky_.info() != Eigen::Success)
        return false;
    if (!analysed_) {
        const std::vector<int> branch = assign_branches(EliminationTree(cholesky_.matrixL().nestedExpression()));
        order_columns(branch);
        order_entries(branch);
    }
    analysed_ = true;
    copy_values();
    return true;
}

void SinglePrecisionFactor::order_columns(const std::vector<int>& branch)
{
    columns_.resize(branch.size());
    std::iota(columns_.begin(), columns_.end(), 0);
    std::stable_sort(columns_.begin(), columns_.end(), [&](int i, int j) { return branch[i] < branch[j]; });
    const auto is_before = [&](int column, int b) { return branch[column] < b; };
    for (int b = 0; b <= k_factor_branches; ++b)
        branch_begin_.push_back(
            int(std::lower_bound(columns_.begin(), columns_.end(), b, is_before) - columns_.begin()));
    new_index_.resize(columns_.size());
    for (std::size_t i = 0; i < columns_.size(); ++i)
        new_index_[columns_[i]] = int(i);
    for (const int column : cholesky_.permutationP().indices())
        place_.push_back(new_index_[column]);
}

// Two passes over a column keep its entries sorted in either part.
void SinglePrecisionFactor::order_entries(const std::vector<int>& branch)
{
    const auto& factor = cholesky_.matrixL().nestedExpression();
    const int* begin = factor.outerIndexPtr();
    const int* row = factor.innerIndexPtr();
    const auto add_entries = [&](int column, bool in_stem) {
        for (int entry = begin[column] + 1; entry < begin[column + 1]; ++entry)
            if ((branch[row[entry]] == k_stem) == in_stem) {
                entries_.push_back(entry);
                rows_.push_back(new_index_[row[entry]]);
            }
    };
    begin_.push_back(0);
    for (const int column : columns_) {
        add_entries(column, false);
        stem_entries_.push_back(int(rows_.size()));
        add_entries(column, true);
        begin_.push_back(int(rows_.size()));
    }
}

void SinglePrecisionFactor::copy_values()
{
    const auto& factor = cholesky_.matrixL().nestedExpression();
    below_.resize(entries_.size());
    for (std::size_t i = 0; i < entries_.size(); ++i)
        below_[i] = float(factor.valuePtr()[entries_[i]]);
    inverse_diagonal_.resize(columns_.size());
    for (std::size_t j = 0; j < columns_.size(); ++j)  // each column begins with its diagonal
        inverse_diagonal_[j] = float(1 / factor.valuePtr()[factor.outerIndexPtr()[columns_[j]]]);
}

// Adds what the columns contribute to the stem to `stem`, whose first element is the stem's first unknown.
void SinglePrecisionFactor::forward(Quads& x, int begin, int end, Eigen::Vector4f* stem) const
{
    const int stem_begin = branch_begin_.back();
    for (int j = begin; j < end; ++j) {
        x[j] *= inverse_diagonal_[j];
        const Eigen::Vector4f value = x[j];
        for (int i = begin_[j]; i < stem_entries_[j]; ++i)
            x[rows_[i]] -= below_[i] * value;
        for (int i = stem_entries_[j]; i < begin_[j + 1]; ++i)
            stem[rows_[i] - stem_begin] -= below_[i] * value;
    }
}

void SinglePrecisionFactor::backward(Quads& x, int begin, int end) const
{
    for (int j = end - 1; j >= begin; --j) {
        Eigen::Vector4f sum = x[j],
                        other = Eigen::Vector4f::Zero();  // two independent sums, for the processor's pipeline
        int i = begin_[j];
        for (; i + 1 < begin_[j + 1]; i += 2) {
            sum -= below_[i] * x[rows_[i]];
            other -= below_[i + 1] * x[rows_[i + 1]];
        }
        if (i < begin_[j + 1])
            sum -= below_[i] * x[rows_[i]];
        x[j] = inverse_diagonal_[j] * (sum + other);
    }
}

Positions SinglePrecisionFactor::solve(const Positions& right) const
{
    const int n = int(right.rows()), stem_begin = branch_begin_.back();
    Quads x(n);
    for (int v = 0; v < n; ++v)
        x[place_[v]] << right.row(v).transpose().cast<float>(), 0;

    std::array<Quads, k_factor_branches> to_stem;
    parallel_for(k_factor_branches, [&](int b) {
        to_stem[b].assign(n - stem_begin, Eigen::Vector4f::Zero());
        forward(x, branch_begin_[b], branch_begin_[b + 1], to_stem[b].data());
    });
    for (const Quads& one : to_stem)
        for (int j = stem_begin; j < n; ++j)
            x[j] += one[j - stem_begin];
    forward(x, stem_begin, n, x.data() + stem_begin);
    backward(x, stem_begin, n);
    parallel_for(k_factor_branches, [&](int b) { backward(x, branch_begin_[b], branch_begin_[b + 1]); });

    Positions result(n, 3);
    for (int v = 0; v < n; ++v)
        result.row(v) = x[place_[v]].head<3>().transpose().cast<double>();
    return result;
}

}  // namespace garmentfit
