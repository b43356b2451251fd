// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The refitted tree: boxes over the primitives of a moving mesh, built once, renewed at every step. On the edges of a
// coat, refitting it and listing all close pairs takes a ninth of the time of CGAL's box intersection, which
// starts from nothing (docs/decisions/0016-trees.md). Static items have MedianTree.

#include <Eigen/Geometry>
#include <vector>

#include "garmentfit/types.h"
#include "parallel.h"
#include "part_of_mesh.h"

namespace garmentfit {

class BoxTree {
public:
    BoxTree() = default;
    /// Groups primitives by the centres of these boxes. O(n log n).
    explicit BoxTree(const std::vector<Box>& boxes);

    /// Renews all boxes and keeps the groups. O(n).
    void refit(const std::vector<Box>& boxes);

    /// Renews the boxes of the primitives for which `is_changed(i)`, by `box_of(i)`. From then on overlaps() lists the pairs
    /// of such primitives alone, with any other.
    template <class IsChanged, class BoxOf>
    void renew(const IsChanged& is_changed, const BoxOf& box_of);
    /// The same of a tree of `count` primitives, which is built where it is empty.
    template <class IsChanged, class BoxOf>
    void renew_or_build(std::size_t count, const IsChanged& is_changed, const BoxOf& box_of);

    bool empty() const { return order_.empty(); }

    /// Calls visit(part, i, j) for every overlapping pair of a primitive i of `a` and j of `b`, at least one of which was
    /// renewed last. Where `a` and `b` are one tree, each pair of two primitives comes once. The search consists of k_parts
    /// parts that run on all threads. Visits of one part come in a fixed order, so results gathered by part are the same
    /// for any number of threads.
    static constexpr int k_parts = 64;  ///< unit: enough to keep all threads busy; decides speed only
    template <class Visit>
    static void overlaps(const BoxTree& a, const BoxTree& b, const Visit& visit);

private:
    /// A box in single precision, rounded outwards, so that no overlap is missed. The fourth number is about 0 and
    /// fills the registers of wide instructions.
    struct Bounds {
        Eigen::Array4f low, high;
        bool meets(const Bounds& other) const { return (low - other.high).max(other.low - high).maxCoeff() <= 0; }
        float girth() const;
        void extend(const Bounds& other);
    };
    struct Node {
        Bounds box;
        int first, count;  // leaves: range of order_; inner nodes: count = 0 and children at first, first + 1
        bool is_changed;
    };
    static Bounds rounded(const Box& box);
    int build(int node, int begin, int end, const std::vector<Box>& boxes);
    void renew_nodes();
    std::vector<int> front(int size) const;
    template <class F>
    static void descend(const BoxTree& a, int na, const BoxTree& b, int nb, const F& f);
    template <class F>
    void descend(int node, const F& f) const;

    std::vector<Node> nodes_;
    std::vector<int> order_;
    std::vector<Bounds> boxes_;  // in the order of order_
    std::vector<char> is_changed_;  // in that order
};

template <class IsChanged, class BoxOf>
void BoxTree::renew(const IsChanged& is_changed, const BoxOf& box_of)
{
    for (std::size_t i = 0; i < order_.size(); ++i) {
        is_changed_[i] = is_changed(order_[i]);
        if (is_changed_[i])
            boxes_[i] = rounded(box_of(order_[i]));
    }
    renew_nodes();
}

template <class IsChanged, class BoxOf>
void BoxTree::renew_or_build(std::size_t count, const IsChanged& is_changed, const BoxOf& box_of)
{
    if (!empty())
        return renew(is_changed, box_of);
    std::vector<Box> boxes(count);
    for (std::size_t i = 0; i < count; ++i)
        boxes[i] = box_of(int(i));
    *this = BoxTree(boxes);
}

template <class F>
void BoxTree::descend(const BoxTree& a, int na, const BoxTree& b, int nb, const F& f)
{
    const Node &x = a.nodes_[na], &y = b.nodes_[nb];
    if (!(x.is_changed || y.is_changed) || !x.box.meets(y.box))
        return;
    if (x.count > 0 && y.count > 0) {
        for (int i = x.first; i < x.first + x.count; ++i)
            for (int j = y.first; j < y.first + y.count; ++j)
                if ((a.is_changed_[i] || b.is_changed_[j]) && a.boxes_[i].meets(b.boxes_[j]))
                    f(a.order_[i], b.order_[j]);
    } else if (y.count > 0 || (x.count == 0 && x.box.girth() >= y.box.girth())) {
        descend(a, x.first, b, nb, f);
        descend(a, x.first + 1, b, nb, f);
    } else {
        descend(a, na, b, y.first, f);
        descend(a, na, b, y.first + 1, f);
    }
}

// Pairs within one subtree, each once.
template <class F>
void BoxTree::descend(int node, const F& f) const
{
    const Node& x = nodes_[node];
    if (!x.is_changed)
        return;
    if (x.count == 0) {
        descend(x.first, f);
        descend(x.first + 1, f);
        descend(*this, x.first, *this, x.first + 1, f);
        return;
    }
    for (int i = x.first; i < x.first + x.count; ++i)
        for (int j = i + 1; j < x.first + x.count; ++j)
            if ((is_changed_[i] || is_changed_[j]) && boxes_[i].meets(boxes_[j]))
                f(order_[i], order_[j]);
}

template <class Visit>
void BoxTree::overlaps(const BoxTree& a, const BoxTree& b, const Visit& visit)
{
    if (a.empty() || b.empty())
        return;
    const std::vector<int> roots = a.front(k_parts);
    parallel_for(int(roots.size()), [&](int part) {
        const auto f = [&](int i, int j) { visit(part, i, j); };
        if (&a != &b)
            return descend(a, roots[part], b, 0, f);
        a.descend(roots[part], f);
        for (std::size_t other = part + 1; other < roots.size(); ++other)
            descend(a, roots[part], a, roots[other], f);
    });
}

}  // namespace garmentfit
