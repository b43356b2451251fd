// SPDX-License-Identifier: GPL-3.0-or-later
#include "figure_graph.h"

#include <gtest/gtest.h>

#include "curve_skeleton.h"

namespace {

using namespace garmentfit;

/// Curves as lines of nodes, each with a square of skin about it.
class Curves {
public:
    /// @param from  node where it begins, or -1. @return its last node
    int add(int from, const Vec3& to, double radius, const Vec3& start = Vec3::Zero())
    {
        const Vec3 first = from < 0 ? start : curves_.nodes[std::size_t(from)];
        if (from < 0)
            from = add_node(first, radius);
        constexpr int steps = 12;
        for (int i = 1; i <= steps; ++i) {
            const int next = add_node(first + (to - first) * i / steps, radius);
            curves_.edges.push_back({ from, next });
            from = next;
        }
        return from;
    }

    const CurveSkeleton& curves() const { return curves_; }
    TriangleMesh skin() const
    {
        TriangleMesh mesh { Positions(Eigen::Index(skin_.size()), 3), Triangles(0, 3) };
        for (std::size_t v = 0; v < skin_.size(); ++v)
            mesh.positions.row(Eigen::Index(v)) = skin_[v];
        return mesh;
    }

private:
    int add_node(const Vec3& place, double radius)
    {
        const int node = int(curves_.nodes.size());
        curves_.nodes.push_back(place);
        for (const Vec3& off : { Vec3(radius, 0, 0), Vec3(-radius, 0, 0), Vec3(0, 0, radius), Vec3(0, 0, -radius) }) {
            skin_.push_back(place + off);
            curves_.node_of_vertex.push_back(node);
        }
        return node;
    }

    CurveSkeleton curves_;
    std::vector<Vec3> skin_;
};

/// Arms held out are not tails beside two twigs in the trunk, which are as far from them on both sides.
TEST(FigureGraph, TwigsInTheMiddleAreNotHandsOfAFigureInASkirt)
{
    Curves c;
    const int waist = c.add(-1, { 0, 0, 0 }, 0.2, { -0.05, -0.95, 0 });  // from the hem
    c.add(waist, { 0.37, 0.03, -0.3 }, 0.06);  // a sword at each hip
    c.add(waist, { -0.37, 0.03, -0.3 }, 0.06);
    const int chest = c.add(waist, { 0, 0.6, 0 }, 0.2);
    c.add(chest, { 0.03, 0.2, 0.02 }, 0.06);
    c.add(chest, { -0.03, 0.2, 0.02 }, 0.06);
    const int left = c.add(chest, { 1.6, 0.67, 0 }, 0.09), right = c.add(chest, { -1.6, 0.67, 0 }, 0.09),
              head = c.add(chest, { 0, 1.05, 0.1 }, 0.15);
    const Figure figure = figure_graph(c.curves(), c.skin());
    EXPECT_TRUE(figure.graph.has_covered_legs);
    EXPECT_EQ(figure.graph.head.back(), head);
    EXPECT_EQ(std::min(figure.graph.arms[0].back(), figure.graph.arms[1].back()), left);
    EXPECT_EQ(std::max(figure.graph.arms[0].back(), figure.graph.arms[1].back()), right);
}

/// A head and a raised arm are a better pair than this and a hanging arm, but no head hangs from the shoulders.
TEST(FigureGraph, AHangingArmIsNotTheHeadOfAFigureThatWaves)
{
    Curves c;
    const int hips = c.add(-1, { 0, 0, 0 }, 0.09, { 0.12, -0.9, 0 });
    c.add(hips, { -0.12, -0.9, 0 }, 0.09);
    const int chest = c.add(hips, { 0, 0.5, 0 }, 0.2);
    const int head = c.add(chest, { 0, 1.2, 0 }, 0.1), raised = c.add(chest, { 0.66, 0.81, 0 }, 0.08),
              hanging = c.add(chest, { -0.35, 0, 0 }, 0.08);
    const Figure figure = figure_graph(c.curves(), c.skin());
    EXPECT_EQ(figure.graph.head.back(), head);
    EXPECT_EQ(std::min(figure.graph.arms[0].back(), figure.graph.arms[1].back()), raised);
    EXPECT_EQ(std::max(figure.graph.arms[0].back(), figure.graph.arms[1].back()), hanging);
}

}  // namespace
