// SPDX-License-Identifier: GPL-3.0-or-later
#include "box_hierarchy.h"

#include <cmath>
#include <limits>

namespace garmentfit {

BoxHierarchy box_hierarchy(const std::vector<FloatBox>& boxes, int leaf_size)
{
    std::vector<BoxedPrimitive> items(boxes.size());
    for (int i = 0; i < int(boxes.size()); ++i)
        items[i] = { boxes[i].center(), i };
    BoxHierarchy tree(
        std::move(items), leaf_size, [](const BoxedPrimitive& item) -> const Eigen::Vector3f& { return item.centre; },
        [](auto) { return BoxNode(); });
    tree.sum_up_from_leaves(
        [&](BoxNode& leaf) {
            for (const BoxedPrimitive& item : tree.items(leaf))
                leaf.box.extend(boxes[item.primitive]);
        },
        [](BoxNode& node, const BoxNode& first, const BoxNode& second) { node.box = first.box.merged(second.box); });
    return tree;
}

FloatBox box_about(const Vec3& low, const Vec3& high)
{
    constexpr float infinity = std::numeric_limits<float>::infinity();
    FloatBox box(low.cast<float>(), high.cast<float>());
    for (int axis = 0; axis < 3; ++axis) {
        if (double(box.min()[axis]) > low[axis])
            box.min()[axis] = std::nextafter(box.min()[axis], -infinity);
        if (double(box.max()[axis]) < high[axis])
            box.max()[axis] = std::nextafter(box.max()[axis], infinity);
    }
    return box;
}

}  // namespace garmentfit
