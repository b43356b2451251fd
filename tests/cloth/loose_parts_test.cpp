// SPDX-License-Identifier: GPL-3.0-or-later
#include "loose_parts.h"

#include <gtest/gtest.h>

#include <set>

#include "cloth_motion.h"
#include "fixtures.h"

namespace garmentfit {
namespace {

/// A sheet of 38 cm with a square of 2 cm above its middle, at this height.
GarmentMesh sheet_with_button(double height)
{
    TriangleMesh mesh = fixtures::sheet(20, 0.02, [](double, double) { return 0; });
    TriangleMesh button = fixtures::sheet(3, 0.01, [&](double, double) { return height; });
    button.positions.rowwise() += Eigen::RowVector3d(0.187, 0, 0.193);
    const TriangleMesh both = fixtures::joined(mesh, button);
    return { both.positions, both.triangles };
}

std::vector<std::pair<int, int>> ties_of(const GarmentMesh& garment)
{
    return find_loose_part_ties(garment, { garment.triangles, int(garment.positions.rows()) });
}

TEST(LooseParts, AreTiedToTheClothTheyLieOnByEachOfTheirVertices)
{
    const GarmentMesh garment = sheet_with_button(0.004);
    std::set<int> tied;
    for (const auto& [part, cloth] : ties_of(garment)) {
        tied.insert(part);
        EXPECT_GE(part, 400);
        EXPECT_LT(cloth, 400);
        EXPECT_LT((garment.positions.row(part) - garment.positions.row(cloth)).norm(), 0.05);
    }
    EXPECT_EQ(tied.size(), 9u);
}

TEST(LooseParts, FarFromAnyClothAreNone) { EXPECT_TRUE(ties_of(sheet_with_button(0.03)).empty()); }

TEST(LooseParts, AreNotWholeLayers)
{
    const TriangleMesh under = fixtures::sheet(20, 0.02, [](double, double) { return 0; }),
                       over = fixtures::sheet(18, 0.02, [](double, double) { return 0.005; });
    const TriangleMesh both = fixtures::joined(under, over);
    EXPECT_TRUE(ties_of({ both.positions, both.triangles }).empty());
}

TEST(LooseParts, StayOnClothThatFalls)
{
    const GarmentMesh garment = sheet_with_button(0.004);
    TriangleMesh floor = fixtures::sheet(2, 1, [](double, double) { return -0.3; });
    floor.positions.rowwise() -= Eigen::RowVector3d(0.3, 0, 0.3);
    const TriangleMesh peg
        = fixtures::polygonise([](const Vec3& p) { return (p - Vec3(0.1, -0.06, 0.1)).norm() - 0.05; },
                               Vec3(0.03, -0.13, 0.03), Vec3(0.17, 0.01, 0.17), 0.01);
    const TriangleMesh obstacle = fixtures::joined(floor, peg);
    ClothMotion motion(garment, garment.positions, obstacle, {});
    settle(motion, obstacle.positions, 60, 0, {});
    const Positions end = motion.cloth();
    ASSERT_LT(end.col(1).minCoeff(), -0.1) << "it slid off the ball";
    for (const auto& [part, cloth] : ties_of(garment))
        EXPECT_NEAR((end.row(part) - end.row(cloth)).norm(),
                    (garment.positions.row(part) - garment.positions.row(cloth)).norm(), 3e-3);
}

}  // namespace
}  // namespace garmentfit
