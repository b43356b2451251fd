// SPDX-License-Identifier: GPL-3.0-or-later
#include "close_seams.h"

#include <gtest/gtest.h>

#include "fixtures.h"
#include "surface_measures.h"

namespace garmentfit {
namespace {

using fixtures::flat;

TriangleMesh closed(const TriangleMesh& mesh)
{
    const MeshTopology topology(mesh.triangles, int(mesh.positions.rows()));
    return close_seams(mesh, topology, find_sewn_pieces({ mesh.positions, mesh.triangles }, topology).ties);
}

std::size_t border_count(const TriangleMesh& mesh)
{
    return MeshTopology(mesh.triangles, int(mesh.positions.rows())).border_edges().size();
}

TEST(CloseSeams, PanelsWithTheSameVerticesBecomeOneSheet)
{
    const TriangleMesh panels = fixtures::joined(flat(20, 0.02, Vec3::Zero()), flat(20, 0.02, Vec3(0.3805, 0, 0)));
    const TriangleMesh sheet = closed(panels);
    EXPECT_EQ(border_count(panels), 8u * 19);
    EXPECT_EQ(border_count(sheet), 6u * 19);
    EXPECT_EQ(sheet.triangles.rows(), panels.triangles.rows());
}

TEST(CloseSeams, VerticesWithNothingOppositeAreInsertedIntoTheEdgesThere)
{
    // 38 cm and 36.8 cm long; the shorter border lies 5 mm from either end of the longer one
    const TriangleMesh panels = fixtures::joined(flat(20, 0.02, Vec3::Zero()), flat(17, 0.023, Vec3(0.3805, 0, 0.006)));
    const TriangleMesh sheet = closed(panels);
    // What is left: three sides of either panel, and both ends of the longer seam.
    EXPECT_EQ(border_count(sheet), 3u * 19 + 3u * 16 + 2u);
    EXPECT_GT(sheet.triangles.rows(), panels.triangles.rows());
    EXPECT_NEAR(area(sheet), area(panels), 0.001 * area(panels));
}

TEST(CloseSeams, AHemBetweenClothAndLiningStaysOpen)
{
    // two sheets that meet at an angle of 20 degrees
    TriangleMesh lining = fixtures::sheet(20, 0.02, [](double x, double) { return 0.0005 + 0.36 * x; });
    const TriangleMesh both = fixtures::joined(flat(20, 0.02, Vec3::Zero()), lining);
    ASSERT_EQ(
        find_sewn_pieces({ both.positions, both.triangles }, MeshTopology(both.triangles, int(both.positions.rows())))
            .counts.seamed,
        1);
    EXPECT_EQ(border_count(closed(both)), border_count(both));
}

TEST(CloseSeams, PiecesThatAreNotSewnStayAsTheyAre)
{
    const TriangleMesh apart = fixtures::joined(flat(20, 0.02, Vec3::Zero()), flat(20, 0.02, Vec3(0.39, 0, 0)));
    const TriangleMesh same = closed(apart);
    EXPECT_EQ(same.positions, apart.positions);
    EXPECT_EQ(same.triangles, apart.triangles);
}

}  // namespace
}  // namespace garmentfit
