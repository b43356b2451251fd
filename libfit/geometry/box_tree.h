// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A hierarchy of boxes over the primitives of a moving mesh: built once, its boxes renewed at every step.

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

    /// Renews all boxes; which primitives are grouped stays. O(n).
    void refit(const std::vector<Box>& boxes);

    bool empty() const { return order_.empty(); }

    /// Calls visit(part, i, j) for every overlapping pair of a primitive i of `a` and j of `b`; of a tree and itself, once for
    /// each pair of two primitives. The search is cut into k_parts parts, run on all threads; visits of one part are in a fixed
    /// order, so results gathered by part are the same for any number of threads.
    using Visit = std::function<void(int part, int i, int j)>;
    static constexpr int k_parts = 64;
    static void overlaps(const BoxTree& a, const BoxTree& b, const Visit& visit);

private:
    /// A box in single precision, rounded outwards, so it misses nothing. The fourth number, about 0, is there for wide instructions.
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
