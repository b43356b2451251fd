// SPDX-License-Identifier: GPL-3.0-or-later
#include "box_tree.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace garmentfit {
namespace {

constexpr int k_leaf_size = 4;  // unit: decides speed, and the order of pairs

}  // namespace

void BoxTree::Bounds::extend(const Bounds& other)
{
    low = low.min(other.low);
    high = high.max(other.high);
}

float BoxTree::Bounds::girth() const { return (high - low).sum(); }

// unit: outwards by one or two units in the last place; a conversion is wrong by half a unit.
BoxTree::Bounds BoxTree::rounded(const Box& box)
{
    Bounds result;
    result.low << box.min().cast<float>(), 0;
    result.high << box.max().cast<float>(), 0;
    const auto ulps = [](const Eigen::Array4f& x) {
        return Eigen::Array4f(x.abs() * std::numeric_limits<float>::epsilon() + std::numeric_limits<float>::min());
    };
    result.low -= ulps(result.low);
    result.high += ulps(result.high);
    return result;
}

BoxTree::BoxTree(const std::vector<Box>& boxes)
{
    order_.resize(boxes.size());
    std::iota(order_.begin(), order_.end(), 0);
    boxes_.resize(boxes.size());
    is_changed_.resize(boxes.size());
    if (boxes.empty())
        return;
    nodes_.reserve(2 * boxes.size());
    nodes_.resize(1);
    build(0, 0, int(boxes.size()), boxes);
    refit(boxes);
}

int BoxTree::build(int node, int begin, int end, const std::vector<Box>& boxes)
{
    if (end - begin <= k_leaf_size) {
        nodes_[node].first = begin;  // refit sets the box
        nodes_[node].count = end - begin;
        return node;
    }
    Box centres;
    for (int i = begin; i < end; ++i)
        centres.extend(boxes[order_[i]].center());
    int axis;
    centres.sizes().maxCoeff(&axis);
    const int middle = (begin + end) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end, [&](int i, int j) {
        const double ci = boxes[i].center()[axis], cj = boxes[j].center()[axis];
        return ci != cj ? ci < cj : i < j;
    });
    const int children = int(nodes_.size());
    nodes_[node].first = children;
    nodes_[node].count = 0;
    nodes_.resize(nodes_.size() + 2);
    build(children, begin, middle, boxes);
    build(children + 1, middle, end, boxes);
    return node;
}

void BoxTree::refit(const std::vector<Box>& boxes)
{
    renew([](int) { return true; }, [&](int i) { return boxes[i]; });
}

void BoxTree::renew_nodes()
{
    for (int n = int(nodes_.size()) - 1; n >= 0; --n) {  // children come after their parents
        Node& node = nodes_[n];
        if (node.count == 0) {
            const Node &one = nodes_[node.first], &other = nodes_[node.first + 1];
            node.is_changed = one.is_changed || other.is_changed;
            if (!node.is_changed)
                continue;
            node.box = one.box;
            node.box.extend(other.box);
            continue;
        }
        const auto first = is_changed_.begin() + node.first;
        node.is_changed = std::find(first, first + node.count, true) != first + node.count;
        if (!node.is_changed)
            continue;
        node.box = boxes_[node.first];
        for (int i = node.first + 1; i < node.first + node.count; ++i)
            node.box.extend(boxes_[i]);
    }
}

std::vector<int> BoxTree::front(int size) const
{
    std::vector<int> nodes { 0 };
    for (std::size_t i = 0; i < nodes.size() && int(nodes.size()) < size;) {
        const Node& node = nodes_[nodes[i]];
        if (node.count > 0) {
            ++i;
            continue;
        }
        nodes.erase(nodes.begin() + i);
        nodes.push_back(node.first);
        nodes.push_back(node.first + 1);
    }
    return nodes;
}

}  // namespace garmentfit
