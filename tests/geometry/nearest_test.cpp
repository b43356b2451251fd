// SPDX-License-Identifier: GPL-3.0-or-later
#include "nearest.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace garmentfit {
namespace {

TEST(NearestPoint, FindsTheNearestWithinADistance)
{
    Positions points(5, 3);
    points << 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3, 0.5, 0, 0;
    const NearestPoint tree(points);
    const auto sorted = [](std::vector<int> found) {
        std::sort(found.begin(), found.end());
        return found;
    };
    EXPECT_EQ(sorted(tree.within(Vec3::Zero(), 2.5, 8)), (std::vector<int> { 0, 1, 2, 4 }));
    EXPECT_EQ(sorted(tree.within(Vec3::Zero(), 2.5, 2)), (std::vector<int> { 0, 4 })) << "the two nearest";
    EXPECT_TRUE(tree.within(Vec3(9, 9, 9), 1, 8).empty());
}

}  // namespace
}  // namespace garmentfit
