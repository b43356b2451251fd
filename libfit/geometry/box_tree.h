// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The refitted tree: boxes over the primitives of a moving mesh, built once, renewed at every step. On the edges of a
// coat, refitting it and listing all close pairs takes a ninth of the time of CGAL's box intersection, which
// starts from nothing (docs/decisions/0016-trees.md). Static items have MedianTree.

#include <Eigen/Geometry>
#include <functional>
#include <vector>

#include "garmentfit/types.h"

namespace garmentfit {

using Box = Eigen::AlignedBox3d;

class BoxTree {
public:
    BoxTree() = default;
    /// Groups primitives by the centres of these boxes. O(n log n).
    explicit BoxTree(const std::vector<Box>& boxes);

    /// Renews all boxes and keeps the groups. O(n).
    void refit(const std::vector<Box>& boxes);

    bool empty() const { return order_.empty(); }

    /// Calls visit(part, i, j) for every overlapping pair of a primitive i of `a` and j of `b`. Where `a` and `b` are
    /// one tree, each pair of two primitives comes once. The search consists of k_parts parts that run on all threads.
    /// Visits of one part come in a fixed order, so results gathered by part are the same for any number of threads.
    using Visit = std::function<void(int part, int i, int j)>;
    static constexpr int k_parts = 64;  ///< unit: enough to keep all threads busy; decides speed only
    static void overlaps(const BoxTree& a, const BoxTree& b, const Visit& visit);

private:
    /// A box in single precision, rounded outwards, so that no overlap is missed. The fourth number is about 0 and
    /// fills the registers of wide instructions.
    struct Bounds {
        Eigen::Array4f low, high;
        bool meets(const Bounds& other) const;
        float girth() const;
        void extend(const Bounds& other);
    };
    struct Node {
        Bounds box;
        int first, count;  // leaves: range of order_; inner nodes: count = 0 and children at first, first + 1
    };
    static Bounds rounded(const Box& box);
    int build(int node, int begin, int end, const std::vector<Box>& boxes);
    std::vector<int> front(int size) const;
    template <class F>
    static void descend(const BoxTree& a, int na, const BoxTree& b, int nb, const F& f);
    template <class F>
    void descend(int node, const F& f) const;

    std::vector<Node> nodes_;
    std::vector<int> order_;
    std::vector<Bounds> boxes_;  // in the order of order_
};

}  // namespace garmentfit
