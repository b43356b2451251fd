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

TEST(TriangleTree, FindsTheNearestTriangleWithinADistance)
{
    TriangleMesh two;
    two.positions.resize(6, 3);
    two.positions << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 3, 1, 0, 3, 0, 1, 3;
    two.triangles.resize(2, 3);
    two.triangles << 0, 1, 2, 3, 4, 5;
    const TriangleTree tree(two);
    const Vec3 place(0.2, 0.3, 1);
    const auto found = tree.nearest_triangle_within(place, 1.5);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->triangle, 0);
    EXPECT_LT((found->point - Vec3(0.2, 0.3, 0)).norm(), 1e-12);
    EXPECT_TRUE(tree.nearest_triangle_within(place, 1)) << "at just this distance";
    EXPECT_FALSE(tree.nearest_triangle_within(place, 0.9));
    EXPECT_EQ(tree.nearest_triangle_within(Vec3(0.2, 0.3, 2), 1.5)->triangle, 1);
    EXPECT_FALSE(TriangleTree(TriangleMesh {}).nearest_triangle_within(place, 9));
}

}  // namespace
}  // namespace garmentfit
