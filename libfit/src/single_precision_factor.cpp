// SPDX-License-Identifier: GPL-3.0-or-later
#include "single_precision_factor.h"

namespace fit {

bool SinglePrecisionFactor::compute(const Eigen::SparseMatrix<double>& system)
{
    if (!analysed_)
        cholesky_.analyzePattern(system);
    analysed_ = true;
    cholesky_.factorize(system);
    if (cholesky_.info() != Eigen::Success)
        return false;
    const auto& factor = cholesky_.matrixL().nestedExpression();
    below_.assign(factor.valuePtr(), factor.valuePtr() + factor.nonZeros());
    inverse_diagonal_.resize(factor.cols());
    for (Eigen::Index j = 0; j < factor.cols(); ++j)  // each column begins with its diagonal
        inverse_diagonal_[j] = 1 / below_[factor.outerIndexPtr()[j]];
    return true;
}

Positions SinglePrecisionFactor::solve(const Positions& right) const
{
    const auto& factor = cholesky_.matrixL().nestedExpression();
    const int* begin = factor.outerIndexPtr();
    const int* row = factor.innerIndexPtr();
    const auto& place = cholesky_.permutationP().indices();
    const int n = int(right.rows());
    std::vector<Eigen::Vector4f> x(n);  // of four, so that each is one register
    for (int v = 0; v < n; ++v)
        x[place[v]] << right.row(v).transpose().cast<float>(), 0;
    for (int j = 0; j < n; ++j) {
        x[j] *= inverse_diagonal_[j];
        for (int i = begin[j] + 1; i < begin[j + 1]; ++i)
            x[row[i]] -= below_[i] * x[j];
    }
    for (int j = n - 1; j >= 0; --j) {
        Eigen::Vector4f sum = x[j];
        for (int i = begin[j] + 1; i < begin[j + 1]; ++i)
            sum -= below_[i] * x[row[i]];
        x[j] = inverse_diagonal_[j] * sum;
    }
    Positions result(n, 3);
    for (int v = 0; v < n; ++v)
        result.row(v) = x[place[v]].head<3>().transpose().cast<double>();
    return result;
}

}  // namespace fit
