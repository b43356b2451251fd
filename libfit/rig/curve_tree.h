// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "curve_skeleton.h"

namespace garmentfit {

/// A graph from which branches are removed.
class CurveTree {
public:
    explicit CurveTree(const CurveSkeleton& skeleton);

    /// Nodes with one neighbour.
    std::vector<int> leaves() const;

    /// Nodes from a leaf to the next fork, the fork included; to the other leaf if there is no fork.
    std::vector<int> branch(int leaf) const;

    double length(const std::vector<int>& path) const;  ///< m

    void remove(const std::vector<int>& branch);

    /// @pre neither node was removed
    std::vector<int> path(int from, int to) const;

private:
    std::vector<Vec3> nodes_;
    std::vector<std::vector<int>> neighbours_;
};

}  // namespace garmentfit
