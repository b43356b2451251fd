// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Boxes within boxes, in single precision, over primitives that stay where they are: quick to build. (BoxTree follows a moving mesh.)

#include <vector>

#include "garmentfit/types.h"

namespace garmentfit {

class BoxHierarchy {
public:
    using Box = Eigen::AlignedBox3f;
    struct Node {
        Box box;
        int begin, end;  // range of order()
        int right;  // second child; the first one follows its parent. 0: a leaf
    };
    static constexpr int k_deepest = 64;  // deeper than any of 2^31 primitives, halved at each level

    BoxHierarchy() = default;
    /// O(n log n). Leaves hold at most so many.
    BoxHierarchy(const std::vector<Box>& boxes, int leaf_size);

    /// The first one is the root; none when there are no boxes.
    const std::vector<Node>& nodes() const { return nodes_; }
    /// Primitives, those of a leaf side by side.
    const std::vector<int>& order() const { return order_; }

private:
    struct Item {
        Eigen::Vector3f centre;
        int primitive;
    };
    int build(std::vector<Item>& items, int begin, int end, const std::vector<Box>& boxes, int leaf_size);

    std::vector<Node> nodes_;
    std::vector<int> order_;
};

/// The smallest box in single precision that certainly holds both, as corners of a box.
BoxHierarchy::Box box_about(const Vec3& low, const Vec3& high);

}  // namespace garmentfit
