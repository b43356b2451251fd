// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numeric>
#include <vector>

namespace garmentfit {

/// Which vertices hang together: disjoint sets.
class DisjointSets {
public:
    explicit DisjointSets(int count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

    /// @return whether they were apart
    bool join(int a, int b)
    {
        a = root(a);
        b = root(b);
        parent_[a] = b;
        return a != b;
    }
    int root(int v)
    {
        while (parent_[v] != v)
            v = parent_[v] = parent_[parent_[v]];
        return v;
    }

private:
    std::vector<int> parent_;
};

}  // namespace garmentfit
