// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The static tree of libfit: items that stay where they are, halved at their median along the longest side of the box
// of their places, until a handful is left. What a node knows of its items (a box, a dipole, a ball) is the user's.
//
// Why not a library: FLANN's KD-tree answers nearest points only, CGAL's AABB tree carries exact kernels into each
// node. Measured ratios: docs/decisions/0016-trees.md, tests/benchmarks/trees.cpp. Meshes that move have BoxTree.
//
// Cost  O(n log n) to build; a query takes no memory but 31 stack frames at most, for 2^31 items are halved 31 times.

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "garmentfit/types.h"

namespace garmentfit {

/// What each node has.
struct TreeNode {
    int begin = 0, end = 0;  ///< range of items()
    int right = 0;  ///< second child; the first one follows its parent. 0: a leaf
};

/// @tparam Node  derives from TreeNode
template <class Item, class Node>
class MedianTree {
public:
    MedianTree() = default;

    /// @param leaf_size  leaves hold at most so many items
    /// @param place      of an item, as a vector
    /// @param sum_up     the node of a std::span<const Item>, asked before the items are sorted any further
    template <class Place, class SumUp>
    MedianTree(std::vector<Item> items, int leaf_size, const Place& place, const SumUp& sum_up) :
        items_(std::move(items))
    {
        nodes_.reserve(items_.size());
        if (!items_.empty())
            build(0, int(items_.size()), leaf_size, place, sum_up);
    }

    /// The first one is the root; none when there are no items. Children stand behind their parents.
    const std::vector<Node>& nodes() const { return nodes_; }
    /// Those of a leaf side by side.
    const std::vector<Item>& items() const { return items_; }
    std::span<const Item> items(const TreeNode& node) const
    {
        return { items_.data() + node.begin, std::size_t(node.end - node.begin) };
    }

    /// Renews all nodes from the leaves up: of_leaf(node), of_children(node, first, second).
    template <class OfLeaf, class OfChildren>
    void sum_up_from_leaves(const OfLeaf& of_leaf, const OfChildren& of_children)
    {
        for (int n = int(nodes_.size()) - 1; n >= 0; --n)
            if (Node& node = nodes_[n]; node.right == 0)
                of_leaf(node);
            else
                of_children(node, nodes_[n + 1], nodes_[node.right]);
    }

    /// Depth first, first children first.
    /// @param enter  takes a node and returns whether to look into it
    /// @param visit  takes a leaf that was entered and returns whether to go on
    template <class Enter, class Visit>
    void walk(const Enter& enter, const Visit& visit) const
    {
        if (!nodes_.empty())
            walk_from(0, enter, visit);
    }

    /// Depth first, of two children the nearer one first.
    /// @param distance  takes a node and returns a number
    /// @param is_near   takes such a number and returns whether to look into the node, asked just before
    /// @param visit     takes a leaf that was entered
    template <class Distance, class IsNear, class Visit>
    void walk_nearest_first(const Distance& distance, const IsNear& is_near, const Visit& visit) const
    {
        if (!nodes_.empty())
            look_into(0, distance, is_near, visit);
    }

private:
    template <class Place, class SumUp>
    int build(int begin, int end, int leaf_size, const Place& place, const SumUp& sum_up)
    {
        const int here = int(nodes_.size());
        nodes_.push_back(sum_up(std::span<const Item>(items_).subspan(begin, end - begin)));
        nodes_[here].begin = begin;
        nodes_[here].end = end;
        if (end - begin <= leaf_size)
            return here;
        using Vector = std::decay_t<decltype(place(items_[0]))>;
        Eigen::AlignedBox<typename Vector::Scalar, 3> places;
        for (int i = begin; i < end; ++i)
            places.extend(place(items_[i]));
        int axis = 0;
        places.sizes().maxCoeff(&axis);
        const int middle = begin + (end - begin) / 2;
        std::nth_element(items_.begin() + begin, items_.begin() + middle, items_.begin() + end,
                         [&](const Item& a, const Item& b) { return place(a)[axis] < place(b)[axis]; });
        build(begin, middle, leaf_size, place, sum_up);
        const int right = build(middle, end, leaf_size, place, sum_up);
        nodes_[here].right = right;
        return here;
    }

    template <class Enter, class Visit>
    bool walk_from(int n, const Enter& enter, const Visit& visit) const
    {
        const Node& node = nodes_[n];
        if (!enter(node))
            return true;
        return node.right == 0 ? visit(node) : walk_from(n + 1, enter, visit) && walk_from(node.right, enter, visit);
    }

    template <class Distance, class IsNear, class Visit>
    void look_into(int n, const Distance& distance, const IsNear& is_near, const Visit& visit) const
    {
        const Node& node = nodes_[n];
        if (node.right == 0)
            return visit(node);
        int first = n + 1, second = node.right;
        auto to_first = distance(nodes_[first]), to_second = distance(nodes_[second]);
        if (to_second < to_first) {
            std::swap(first, second);
            std::swap(to_first, to_second);
        }
        if (is_near(to_first))
            look_into(first, distance, is_near, visit);
        if (is_near(to_second))
            look_into(second, distance, is_near, visit);
    }

    std::vector<Node> nodes_;
    std::vector<Item> items_;
};

}  // namespace garmentfit
