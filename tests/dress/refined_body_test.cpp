// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/refined_body.h"

#include <algorithm>
#include <map>

#include <gtest/gtest.h>

#include "fixtures.h"
#include "garmentfit/rig_body.h"
#include "proxy_surface.h"
#include "surface_measures.h"
#include "topology.h"

namespace {

using namespace garmentfit;
using namespace garmentfit::fixtures;

/// Of some hundred large triangles.
RiggedBody coarse_person()
{
    const TriangleMesh mesh = proxy_surface(capsule_person({ .arm_angle = 20 }).mesh, 160);
    RiggedBody result { make_body(mesh.positions, mesh.triangles), {} };
    result.rig = rig_body(result.body);
    return result;
}

double longest_edge(const TriangleMesh& mesh)
{
    double longest = 0;
    const Edges edges = edges_of(mesh.triangles);
    for (const auto& edge : edges.rowwise())
        longest = std::max(longest, (mesh.positions.row(edge[0]) - mesh.positions.row(edge[1])).norm());
    return longest;
}

TEST(RefinedBody, IsOnlyForBodiesOfLargeTriangles)
{
    EXPECT_TRUE(has_large_triangles(coarse_person().body));
    const TriangleMesh mesh = capsule_person().mesh;
    EXPECT_FALSE(has_large_triangles(make_body(mesh.positions, mesh.triangles)));
}

TEST(RefinedBody, HasNoTrianglesToRefine)
{
    const auto [body, rig] = coarse_person();
    EXPECT_TRUE(has_triangles_to_refine(body));
    EXPECT_FALSE(has_triangles_to_refine(refine_body(body, rig).body));
    const TriangleMesh middle = proxy_surface(capsule_person({ .arm_angle = 20 }).mesh, 800);
    const BodyMesh between = make_body(middle.positions, middle.triangles);
    EXPECT_TRUE(has_triangles_to_refine(between));
    EXPECT_FALSE(has_large_triangles(between));
}

TEST(RefinedBody, IsTheSameSurfaceOfSmallTriangles)
{
    const auto [body, rig] = coarse_person();
    const auto [refined, refined_rig] = refine_body(body, rig);
    const Eigen::Index count = body.surface.positions.rows();
    EXPECT_EQ(refined.surface.positions.topRows(count), body.surface.positions);
    EXPECT_EQ(refined_rig.weights.weights.topRows(count), rig.weights.weights);
    EXPECT_EQ(refined.closed.positions, body.closed.positions);
    EXPECT_GT(longest_edge(body.surface), 0.15);
    EXPECT_LT(longest_edge(refined.surface), 0.05);
    EXPECT_NEAR(area(refined.surface), area(body.surface), 1e-9);
    EXPECT_NEAR(volume(refined.surface), volume(body.surface), 1e-9);
    const MeshTopology topology(refined.surface.triangles, int(refined.surface.positions.rows()));
    EXPECT_TRUE(topology.border_edges().empty()) << "no triangle ends in the middle of an edge of another";
    EXPECT_EQ(refined_rig.weights.weights.rows(), refined.surface.positions.rows());
    EXPECT_LT((refined_rig.weights.weights.rowwise().sum().array() - 1).abs().maxCoeff(), 1e-12);
}

TEST(RefinedBody, HalvesBothSidesOfASeamAlike)
{
    TriangleMesh strip { Positions(6, 3), Triangles(2, 3) };
    strip.positions << 0, 0, 0, 0, 1, 0, 0.3, 0.2, 0, 0, 1, 0, 0, 0, 0, -0.7, 0.5, 0;
    strip.triangles << 0, 2, 1, 3, 5, 4;
    Rig rig;
    rig.weights = on_bone(thorax, 6);
    const Positions refined = refine_body({ strip, strip }, rig).body.surface.positions;
    std::map<double, int> on_seam;
    for (const auto& p : refined.rowwise())
        if (p.x() == 0)
            ++on_seam[p.y()];
    EXPECT_GE(on_seam.size(), 23u);
    for (const auto& [height, vertices] : on_seam)
        EXPECT_EQ(vertices, 2) << height;
}

}  // namespace
