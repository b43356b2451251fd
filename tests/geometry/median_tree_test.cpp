// SPDX-License-Identifier: GPL-3.0-or-later
#include "median_tree.h"

#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace {

using namespace garmentfit;

struct Sum : TreeNode {
    Vec3 sum = Vec3::Zero();
    Eigen::AlignedBox3d box;
};
using Tree = MedianTree<Vec3, Sum>;

std::vector<Vec3> random_points(int count)
{
    std::mt19937 random(1);
    std::uniform_int_distribution<int> number(-1000, 1000);
    std::vector<Vec3> points;
    for (int i = 0; i < count; ++i) {
        const int x = number(random), y = number(random), z = number(random);
        points.emplace_back(x, y, z);
    }
    return points;
}

Tree tree_of(std::vector<Vec3> points)
{
    return { std::move(points), 4, [](const Vec3& p) -> const Vec3& { return p; },
             [](std::span<const Vec3> some) {
                 Sum node;
                 for (const Vec3& p : some) {
                     node.sum += p;
                     node.box.extend(p);
                 }
                 return node;
             } };
}

TEST(MedianTree, EveryNodeIsTheSumOfItsChildren)
{
    const Tree tree = tree_of(random_points(1000));
    for (int n = 0; n < int(tree.nodes().size()); ++n) {
        const Sum& node = tree.nodes()[n];
        if (node.right == 0) {
            EXPECT_LE(node.end - node.begin, 4);
            continue;
        }
        const Sum &first = tree.nodes()[n + 1], &second = tree.nodes()[node.right];
        EXPECT_EQ(node.sum, first.sum + second.sum);  // exact: integers
        EXPECT_EQ(first.begin, node.begin);
        EXPECT_EQ(first.end, second.begin);
        EXPECT_EQ(second.end, node.end);
    }
}

TEST(MedianTree, AWalkComesToEachItemOnceAndEndsWhenTold)
{
    const Tree tree = tree_of(random_points(1000));
    int next = 0;
    tree.walk([](const Sum&) { return true; },
              [&](const Sum& leaf) {
                  EXPECT_EQ(leaf.begin, next);
                  next = leaf.end;
                  return true;
              });
    EXPECT_EQ(next, 1000);
    int leaves = 0;
    tree.walk([](const Sum&) { return true; }, [&](const Sum&) { return ++leaves < 3; });
    EXPECT_EQ(leaves, 3);
}

TEST(MedianTree, NearestFirstFindsTheNearestAndLeavesMostNodesOut)
{
    const Tree tree = tree_of(random_points(4000));
    for (const Vec3& query : random_points(50)) {
        const Vec3 at = query + Vec3(0.3, 0.4, 0.5);
        double nearest = std::numeric_limits<double>::infinity(), all = nearest;
        int visited = 0;
        tree.walk_nearest_first([&](const Sum& node) { return node.box.exteriorDistance(at); },
                                [&](double distance) { return distance < nearest; },
                                [&](const Sum& leaf) {
                                    for (const Vec3& p : tree.items(leaf))
                                        nearest = std::min(nearest, (p - at).norm());
                                    visited += leaf.end - leaf.begin;
                                });
        for (const Vec3& p : tree.items())
            all = std::min(all, (p - at).norm());
        EXPECT_EQ(nearest, all);
        EXPECT_LT(visited, 400);
    }
}

TEST(MedianTree, AnEmptyOneHasNothingToWalk)
{
    const Tree tree = tree_of({});
    EXPECT_TRUE(tree.nodes().empty());
    tree.walk([](const Sum&) { return true; },
              [](const Sum&) {
                  ADD_FAILURE();
                  return true;
              });
}

}  // namespace
