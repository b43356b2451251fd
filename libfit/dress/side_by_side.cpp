// SPDX-License-Identifier: GPL-3.0-or-later
#include "side_by_side.h"

#include <algorithm>

#include <Eigen/SparseCholesky>

#include "nearest.h"
#include "parallel.h"
#include "tuning.h"

namespace garmentfit {

SideBySide::SideBySide(const Positions& rest, const MeshTopology& topology, const Positions& moved) :
    links_(rest.rows())
{
    const double edge = mean_edge_length(rest, topology.edges());
    const auto link = [&](int from, int to) {
        links_[from].push_back({ to, 1 / std::max(k_least_link * edge, (rest.row(from) - rest.row(to)).norm()) });
    };
    const NearestPoint tree(rest);
    std::vector<std::vector<int>> near(rest.rows());
    parallel_for(rest.rows(),
                 [&](Eigen::Index v) { near[v] = tree.within(rest.row(v), k_beside * edge, k_most_links); });
    for (int v = 0; v < int(rest.rows()); ++v) {
        for (const int n : topology.neighbours(v))
            link(v, n);
        for (const int n : near[v])
            if (n != v && (moved.row(v) - moved.row(n)).norm() < k_apart) {
                link(v, n);
                link(n, v);
            }
    }
}

void SideBySide::spread(std::vector<char>& marks, int links) const
{
    std::vector<int> front;
    for (int v = 0; v < int(marks.size()); ++v)
        if (marks[v])
            front.push_back(v);
    for (; links > 0; --links) {
        std::vector<int> next;
        for (const int v : front)
            for (const Link& link : links_[v])
                if (!std::exchange(marks[link.to], 1))
                    next.push_back(link.to);
        front = std::move(next);
    }
}

Eigen::MatrixXd SideBySide::evened(const Eigen::MatrixXd& field, const std::vector<char>& marks, double hold) const
{
    std::vector<int> index(marks.size(), -1), marked;
    for (int v = 0; v < int(marks.size()); ++v)
        if (marks[v]) {
            index[v] = int(marked.size());
            marked.push_back(v);
        }
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::MatrixXd pull(marked.size(), field.cols());
    for (int i = 0; i < int(marked.size()); ++i) {
        const int v = marked[i];
        double sum = 0;
        pull.row(i).setZero();
        for (const Link& link : links_[v]) {
            sum += link.weight;
            if (index[link.to] >= 0)
                entries.emplace_back(i, index[link.to], -link.weight);
            else
                pull.row(i) += link.weight * field.row(link.to);
        }
        const double own = hold * std::max(sum, 1.0);  // also of a vertex without links
        pull.row(i) += own * field.row(v);
        entries.emplace_back(i, i, sum + own);
    }
    Eigen::SparseMatrix<double> system(Eigen::Index(marked.size()), Eigen::Index(marked.size()));
    system.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(system);
    if (factor.info() != Eigen::Success)
        return field;  // nothing holds what is marked
    const Eigen::MatrixXd values = factor.solve(pull);
    Eigen::MatrixXd result = field;
    for (int i = 0; i < int(marked.size()); ++i)
        result.row(marked[i]) = values.row(i);
    return result;
}

}  // namespace garmentfit
