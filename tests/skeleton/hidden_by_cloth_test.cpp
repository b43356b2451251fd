// SPDX-License-Identifier: GPL-3.0-or-later
#include "hidden_by_cloth.h"

#include <gtest/gtest.h>

#include "fixtures.h"

namespace {

using namespace garmentfit;
using namespace garmentfit::fixtures;

/// A square in the plane y = 0 that faces up, its vertices in its middle.
TriangleMesh small_skin()
{
    TriangleMesh skin { Positions(4, 3), Triangles(2, 3) };
    skin.positions << -0.01, 0, -0.01, -0.01, 0, 0.01, 0.01, 0, 0.01, 0.01, 0, -0.01;
    skin.triangles << 0, 1, 2, 0, 2, 3;
    return skin;
}

/// Walls over z > 0, from the skin's plane to high above it.
TriangleMesh half_a_room(double wall)
{
    TriangleMesh cloth { Positions(4, 3), Triangles(2, 3) };
    cloth.positions << -50, 0, wall, 50, 0, wall, 50, 50, wall, -50, 50, wall;
    cloth.triangles << 0, 1, 2, 0, 2, 3;
    return cloth;
}

TEST(HiddenByCloth, IsTheShareOfDirections)
{
    const TriangleMesh skin = small_skin();
    const std::vector<Vec3> directions = viewing_directions(400);
    EXPECT_TRUE(shares_hidden_by_cloth(skin, {}, directions, 0.001).isZero(0));
    const Eigen::VectorXd shares = shares_hidden_by_cloth(skin, half_a_room(0.02), directions, 0.001);
    for (Eigen::Index v = 0; v < shares.size(); ++v)
        EXPECT_NEAR(shares[v], 0.5, 0.03) << "half of what is above lies beyond the wall";

    TriangleMesh lid { Positions(3, 3), Triangles(1, 3) };
    lid.positions << -90, 0.001, -50, 90, 0.001, -50, 0, 0.001, 90;
    lid.triangles << 0, 1, 2;
    EXPECT_GT(shares_hidden_by_cloth(skin, lid, directions, 0.001).minCoeff(), 0.97);
}

TEST(HiddenByCloth, LooksFromAllSides)
{
    Vec3 sum = Vec3::Zero();
    for (int phase = 0; phase < 3; ++phase)
        for (const Vec3& direction : viewing_directions(50, phase, 3)) {
            EXPECT_NEAR(direction.norm(), 1, 1e-12);
            EXPECT_GT(direction.y(), 0) << "each serves two viewers";
            sum += direction;
        }
    EXPECT_LT((sum / 150 - Vec3(0, 0.5, 0)).norm(), 0.02);
}

}  // namespace
