// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve_loops.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace {

using namespace garmentfit;

/// A ring of nodes with a long tail at its first node.
CurveSkeleton ring_with_tail(int nodes, double radius)
{
    CurveSkeleton skeleton;
    for (int i = 0; i < nodes; ++i) {
        const double angle = 2 * std::numbers::pi * i / nodes;
        skeleton.nodes.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
        skeleton.edges.push_back({ i, (i + 1) % nodes });
    }
    for (int i = 0; i < 10; ++i) {
        skeleton.nodes.emplace_back(radius + 0.1 * (i + 1), 0, 0);
        skeleton.edges.push_back({ i == 0 ? 0 : nodes + i - 1, nodes + i });
    }
    return skeleton;
}

/// Whether all nodes are connected by as few edges as possible.
bool is_tree(const CurveSkeleton& skeleton)
{
    std::vector<bool> reached(skeleton.nodes.size(), false);
    reached[0] = true;
    for (std::size_t round = 0; round < skeleton.nodes.size(); ++round)
        for (const auto& [a, b] : skeleton.edges)
            if (reached[a] || reached[b])
                reached[a] = reached[b] = true;
    return skeleton.edges.size() + 1 == skeleton.nodes.size()
        && std::all_of(reached.begin(), reached.end(), [](bool r) { return r; });
}

TEST(CurveLoops, ATreeStaysAsItIs)
{
    CurveSkeleton tree = ring_with_tail(8, 0.2);
    tree.edges.erase(tree.edges.begin() + 4);
    const std::vector<CurveSkeleton> trees = open_loops(tree);
    ASSERT_EQ(trees.size(), 1u);
    EXPECT_EQ(trees[0].edges, tree.edges);
}

TEST(CurveLoops, AShortLoopIsCutOnceFarFromTheMiddle)
{
    const std::vector<CurveSkeleton> trees = open_loops(ring_with_tail(8, 0.015));
    ASSERT_EQ(trees.size(), 1u);
    EXPECT_TRUE(is_tree(trees[0]));
    const auto& edges = trees[0].edges;  // the tail leads to +x, so the loop's far edges are at -x
    EXPECT_EQ(std::count(edges.begin(), edges.end(), std::array<int, 2> { 0, 1 }), 1);
}

TEST(CurveLoops, ALongLoopIsCutBesideItsForkAndHalfwayRound)
{
    const std::vector<CurveSkeleton> trees = open_loops(ring_with_tail(8, 0.3));
    EXPECT_EQ(trees.size(), 3u);
    for (const CurveSkeleton& tree : trees)
        EXPECT_TRUE(is_tree(tree));
}

}  // namespace
