// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A MedianTree of boxes in single precision, over primitives that stay where they are.

#include <vector>

#include "median_tree.h"

namespace garmentfit {

using FloatBox = Eigen::AlignedBox3f;

struct BoxNode : TreeNode {
    FloatBox box;
};
struct BoxedPrimitive {
    Eigen::Vector3f centre;  ///< of its box
    int primitive;
};
using BoxHierarchy = MedianTree<BoxedPrimitive, BoxNode>;

/// Over one box for each primitive. O(n log n).
BoxHierarchy box_hierarchy(const std::vector<FloatBox>& boxes, int leaf_size);

/// The smallest box in single precision that certainly holds both, as corners of a box.
FloatBox box_about(const Vec3& low, const Vec3& high);

}  // namespace garmentfit
