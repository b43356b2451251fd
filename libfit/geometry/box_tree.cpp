// SPDX-License-Identifier: GPL-3.0-or-later
#include "box_tree.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "parallel.h"

namespace garmentfit {
namespace {

constexpr int k_leaf_size = 4;  // unit: decides speed, and the order of pairs

}  // namespace

bool BoxTree::Bounds::meets(const Bounds& other) const
{
    return (low - other.high).max(other.low - high).maxCoeff() <= 0;
}

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
    for (std::size_t i = 0; i < order_.size(); ++i)
        boxes_[i] = rounded(boxes[order_[i]]);
    for (int n = int(nodes_.size()) - 1; n >= 0; --n) {  // children come after their parents
        Node& node = nodes_[n];
        if (node.count == 0) {
            node.box = nodes_[node.first].box;
            node.box.extend(nodes_[node.first + 1].box);
            continue;
        }
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

template <class F>
void BoxTree::descend(const BoxTree& a, int na, const BoxTree& b, int nb, const F& f)
{
    const Node &x = a.nodes_[na], &y = b.nodes_[nb];
    if (!x.box.meets(y.box))
        return;
    if (x.count > 0 && y.count > 0) {
        for (int i = x.first; i < x.first + x.count; ++i)
            for (int j = y.first; j < y.first + y.count; ++j)
                if (a.boxes_[i].meets(b.boxes_[j]))
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
    if (x.count == 0) {
        descend(x.first, f);
        descend(x.first + 1, f);
        descend(*this, x.first, *this, x.first + 1, f);
        return;
    }
    for (int i = x.first; i < x.first + x.count; ++i)
        for (int j = i + 1; j < x.first + x.count; ++j)
            if (boxes_[i].meets(boxes_[j]))
                f(order_[i], order_[j]);
}

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
