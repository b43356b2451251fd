// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve_tree.h"

#include <algorithm>

namespace garmentfit {

CurveTree::CurveTree(const CurveSkeleton& skeleton) : nodes_(skeleton.nodes), neighbours_(skeleton.nodes.size())
{
    for (const auto& [a, b] : skeleton.edges) {
        neighbours_[a].push_back(b);
        neighbours_[b].push_back(a);
    }
}

std::vector<int> CurveTree::leaves() const
{
    std::vector<int> result;
    for (int n = 0; n < int(nodes_.size()); ++n)
        if (neighbours_[n].size() == 1)
            result.push_back(n);
    return result;
}

std::vector<int> CurveTree::branch(int leaf) const
{
    std::vector<int> nodes { leaf };
    for (int before = -1, n = leaf;;) {
        const auto next
            = std::find_if(neighbours_[n].begin(), neighbours_[n].end(), [&](int m) { return m != before; });
        if (next == neighbours_[n].end())
            return nodes;
        before = n;
        n = *next;
        nodes.push_back(n);
        if (neighbours_[n].size() != 2)
            return nodes;
    }
}

double CurveTree::length(const std::vector<int>& path) const
{
    double sum = 0;
    for (std::size_t i = 1; i < path.size(); ++i)
        sum += (nodes_[path[i]] - nodes_[path[i - 1]]).norm();
    return sum;
}

void CurveTree::remove(const std::vector<int>& branch)
{
    for (std::size_t i = 0; i + 1 < branch.size(); ++i)
        neighbours_[branch[i]].clear();
    auto& fork = neighbours_[branch.back()];
    fork.erase(std::find(fork.begin(), fork.end(), branch[branch.size() - 2]));
}

std::vector<int> CurveTree::path(int from, int to) const
{
    std::vector<int> before(nodes_.size(), -1), front { to };
    before[to] = to;
    for (std::size_t i = 0; i < front.size() && before[from] < 0; ++i)
        for (const int n : neighbours_[front[i]])
            if (before[n] < 0) {
                before[n] = front[i];
                front.push_back(n);
            }
    std::vector<int> result { from };
    while (result.back() != to)
        result.push_back(before[result.back()]);
    return result;
}

}  // namespace garmentfit
