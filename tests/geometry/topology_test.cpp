// SPDX-License-Identifier: GPL-3.0-or-later
#include "topology.h"

#include <map>
#include <set>
#include <utility>

#include <gtest/gtest.h>

#include "fixtures.h"

namespace {

using namespace garmentfit;

// A fan about vertex 0 that is open between 5 and 1; 6 belongs to nothing.
const Triangles k_fan = (Triangles(4, 3) << 0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5).finished();

Triangles ball_triangles()
{
    return fixtures::polygonise([](const Vec3& p) { return p.norm() - 1; }, Vec3::Constant(-1.5), Vec3::Constant(1.5),
                                0.3)
        .triangles;
}

std::vector<int> list(std::span<const int> items) { return { items.begin(), items.end() }; }

TEST(Topology, EdgesAreThoseOfEdgesOf)
{
    for (const Triangles& triangles : { k_fan, ball_triangles() })
        EXPECT_EQ(MeshTopology(triangles, triangles.maxCoeff() + 1).edges(), edges_of(triangles));
}

TEST(Topology, SidesAtEachEdgeAreThoseOfTheTrianglesWithBothVertices)
{
    const Triangles triangles = ball_triangles();
    std::map<std::pair<int, int>, std::vector<int>> sides;
    for (int s = 0; s < int(triangles.size()); ++s)
        sides[std::minmax(triangles(s / 3, s % 3), triangles(s / 3, (s % 3 + 1) % 3))].push_back(s);
    const MeshTopology topology(triangles, triangles.maxCoeff() + 1);
    ASSERT_EQ(topology.edges().rows(), Eigen::Index(sides.size()));
    for (const auto& [edge, at] : sides) {
        const int e = topology.edge_between(edge.second, edge.first);
        ASSERT_GE(e, 0);
        EXPECT_EQ(list(topology.sides_at(e)), at);
        for (const int s : at) {
            EXPECT_EQ(topology.edge_of(s), e);
            EXPECT_EQ(topology.opposite(s), at[0] == s ? at[1] : at[0]);
        }
    }
}

TEST(Topology, NeighboursAscendAndAStrayVertexHasNone)
{
    const MeshTopology topology(k_fan, 7);
    EXPECT_EQ(list(topology.neighbours(0)), (std::vector { 1, 2, 3, 4, 5 }));
    EXPECT_EQ(list(topology.neighbours(3)), (std::vector { 0, 2, 4 }));
    EXPECT_TRUE(topology.neighbours(6).empty());
    EXPECT_EQ(topology.edge_between(1, 3), -1);
}

TEST(Topology, AnOpenFanHasOneBorderInTheDirectionOfItsTriangles)
{
    const auto loops = MeshTopology(k_fan, 7).border_loops();
    ASSERT_EQ(loops.size(), 1u);
    EXPECT_EQ(loops[0], (std::vector { 0, 1, 2, 3, 4, 5 }));
}

TEST(Topology, AClosedSurfaceHasNoBorderAndATubeHasTwo)
{
    const Triangles ball = ball_triangles();
    EXPECT_TRUE(MeshTopology(ball, ball.maxCoeff() + 1).border_edges().empty());
    Triangles ring(8, 3);  // between the rings 0..3 and 4..7
    for (int i = 0; i < 4; ++i) {
        const int j = (i + 1) % 4;
        ring.row(2 * i) << i, j, 4 + j;
        ring.row(2 * i + 1) << i, 4 + j, 4 + i;
    }
    const auto loops = MeshTopology(ring, 8).border_loops();
    ASSERT_EQ(loops.size(), 2u);
    EXPECT_EQ(loops[0], (std::vector { 0, 1, 2, 3 }));
    EXPECT_EQ(std::set<int>(loops[1].begin(), loops[1].end()), (std::set { 4, 5, 6, 7 }));
}

TEST(Topology, ThreeTrianglesAtAnEdgeAreNeitherBorderNorOpposite)
{
    const Triangles book = (Triangles(3, 3) << 0, 1, 2, 0, 1, 3, 0, 1, 4).finished();
    const MeshTopology topology(book, 5);
    const int spine = topology.edge_between(0, 1);
    EXPECT_EQ(topology.sides_at(spine).size(), 3u);
    EXPECT_FALSE(topology.is_border(spine));
    EXPECT_EQ(topology.opposite(0), -1);
}

TEST(Topology, ASideWithoutLengthLiesOnNoEdge)
{
    const Triangles flat = (Triangles(1, 3) << 0, 0, 1).finished();
    const MeshTopology topology(flat, 2);
    EXPECT_EQ(topology.edge_of(0), -1);
    EXPECT_EQ(topology.opposite(0), -1);
    EXPECT_EQ(topology.edges().rows(), 1);
}

TEST(Topology, MeanEdgeLengthAndNeighbourSumsAreThoseByHand)
{
    const Triangles triangle = (Triangles(1, 3) << 0, 1, 2).finished();
    const Positions corners = (Positions(3, 3) << 0, 0, 0, 3, 0, 0, 0, 4, 0).finished();
    const Edges edges = MeshTopology(triangle, 3).edges();
    EXPECT_DOUBLE_EQ(mean_edge_length(corners, edges), 4);
    EXPECT_EQ(mean_edge_length(corners, Edges(0, 2)), 0);
    Positions sums = Positions::Zero(3, 3);
    add_neighbours(edges, corners, sums);
    EXPECT_EQ(sums, (Positions(3, 3) << 3, 4, 0, 0, 4, 0, 3, 0, 0).finished());
    EXPECT_EQ(edge_counts(edges, 4), Eigen::Vector4d(2, 2, 2, 0));
}

}  // namespace
