// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numeric>
#include <vector>

namespace garmentfit {

/// Connected components by union-find: sets that are joined pair by pair. Names of sets depend on the order of joins.
class DisjointSets {
public:
    explicit DisjointSets(int count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

    /// @return whether the two were in different sets
    bool join(int a, int b)
    {
        a = root(a);
        b = root(b);
        parent_[a] = b;
        return a != b;
    }
    /// The name of the set: one of its members.
    int root(int v)
    {
        while (parent_[v] != v)
            v = parent_[v] = parent_[parent_[v]];
        return v;
    }
    /// The members of each set, ascending; the sets in the order of their first members.
    std::vector<std::vector<int>> groups()
    {
        std::vector<int> number(parent_.size(), -1);  // by root
        std::vector<std::vector<int>> result;
        for (int v = 0; v < int(parent_.size()); ++v) {
            int& group = number[root(v)];
            if (group < 0) {
                group = int(result.size());
                result.emplace_back();
            }
            result[group].push_back(v);
        }
        return result;
    }

private:
    std::vector<int> parent_;
};

}  // namespace garmentfit
