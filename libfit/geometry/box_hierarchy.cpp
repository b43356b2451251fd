// SPDX-License-Identifier: GPL-3.0-or-later
#include "box_hierarchy.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace garmentfit {

BoxHierarchy::BoxHierarchy(const std::vector<Box>& boxes, int leaf_size)
{
    std::vector<Item> items(boxes.size());
    for (int i = 0; i < int(boxes.size()); ++i)
        items[i] = { boxes[i].center(), i };
    nodes_.reserve(boxes.size());
    order_.reserve(boxes.size());
    if (!items.empty())
        build(items, 0, int(items.size()), boxes, leaf_size);
}

int BoxHierarchy::build(std::vector<Item>& items, int begin, int end, const std::vector<Box>& boxes, int leaf_size)
{
    const int here = int(nodes_.size());
    nodes_.push_back({ Box(), begin, end, 0 });
    Box box;
    if (end - begin <= leaf_size) {
        for (int i = begin; i < end; ++i) {
            order_.push_back(items[i].primitive);
            box.extend(boxes[items[i].primitive]);
        }
    } else {
        Box centres;
        for (int i = begin; i < end; ++i)
            centres.extend(items[i].centre);
        int axis = 0;
        centres.sizes().maxCoeff(&axis);
        const int middle = begin + (end - begin) / 2;
        std::nth_element(items.begin() + begin, items.begin() + middle, items.begin() + end,
                         [axis](const Item& a, const Item& b) { return a.centre[axis] < b.centre[axis]; });
        const int left = build(items, begin, middle, boxes, leaf_size);
        const int right = build(items, middle, end, boxes, leaf_size);
        box = nodes_[left].box.merged(nodes_[right].box);
        nodes_[here].right = right;
    }
    nodes_[here].box = box;
    return here;
}

BoxHierarchy::Box box_about(const Vec3& low, const Vec3& high)
{
    constexpr float infinity = std::numeric_limits<float>::infinity();
    BoxHierarchy::Box box(low.cast<float>(), high.cast<float>());
    for (int axis = 0; axis < 3; ++axis) {
        if (double(box.min()[axis]) > low[axis])
            box.min()[axis] = std::nextafter(box.min()[axis], -infinity);
        if (double(box.max()[axis]) < high[axis])
            box.max()[axis] = std::nextafter(box.max()[axis], infinity);
    }
    return box;
}

}  // namespace garmentfit
