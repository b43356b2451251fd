// SPDX-License-Identifier: GPL-3.0-or-later
#include "garment_openings.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "fixtures.h"
#include "outward_cloth.h"

namespace {

using namespace garmentfit;

constexpr double k_radius = 0.08, k_length = 0.5;  // m

/// An open tube along the y axis, its rows closer together than slices are wide.
TriangleMesh tube()
{
    constexpr int around = 48, rows = 201;
    TriangleMesh mesh { Positions(around * rows, 3), Triangles(2 * around * (rows - 1), 3) };
    for (int i = 0; i < rows; ++i)
        for (int k = 0; k < around; ++k) {
            const double angle = 2 * std::numbers::pi * k / around;
            const int here = i * around + k, next = i * around + (k + 1) % around;
            mesh.positions.row(here) << k_radius * std::sin(angle), k_length * i / (rows - 1),
                k_radius * std::cos(angle);
            if (i + 1 < rows) {
                mesh.triangles.row(2 * here) << here, next, here + around;
                mesh.triangles.row(2 * here + 1) << next, next + around, here + around;
            }
        }
    return outward_cloth(make_garment(mesh.positions, mesh.triangles));
}

TriangleMesh ball()
{
    return fixtures::polygonise([](const Vec3& p) { return p.norm() - 0.3; }, Vec3::Constant(-0.5), Vec3::Constant(0.5),
                                0.1);
}

TEST(GarmentOpenings, OfATubeAreItsTwoEndsWithTheTubeBetween)
{
    const Vec3 axis = Vec3::UnitY();
    const std::vector<Opening> openings = openings_of(tube());
    ASSERT_EQ(openings.size(), 2u);
    for (const Opening& opening : openings) {
        EXPECT_NEAR(opening.girth, 2 * std::numbers::pi * k_radius, 0.01);
        EXPECT_NEAR(opening.tube_girth, opening.girth, 0.1 * opening.girth);
        EXPECT_NEAR(opening.tube_length, k_length, 0.1 * k_length);
        EXPECT_NEAR(std::abs(opening.facing.dot(axis)), 1, 1e-3);
    }
    const Vec3 apart = openings[1].centre - openings[0].centre;
    EXPECT_NEAR(apart.norm(), k_length, 1e-6);
    EXPECT_GT(openings[1].facing.dot(apart), 0);  // outwards
    EXPECT_LT(openings[0].facing.dot(apart), 0);
    EXPECT_TRUE(face_alike(openings[0], openings[1], axis));
}

TEST(GarmentOpenings, RotateWithTheirGarment)
{
    const TriangleMesh cloth = tube();
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(1, Vec3(1, 2, 3).normalized()));
    const TriangleMesh rotated = rotate(cloth, turn);
    const std::vector<Opening> expected = openings_of(rotated), result = rotate(openings_of(cloth), rotated, turn);
    ASSERT_EQ(result.size(), expected.size());
    for (std::size_t i = 0; i < result.size(); ++i) {
        EXPECT_LT((result[i].centre - expected[i].centre).norm(), 1e-9);
        EXPECT_LT((result[i].facing - expected[i].facing).norm(), 1e-9);
        EXPECT_LT((result[i].low - expected[i].low).norm(), 1e-9);
        EXPECT_NEAR(result[i].piece_height, expected[i].piece_height, 1e-9);
    }
}

TEST(GarmentOpenings, ABallHasNoneAndIsSealed)
{
    EXPECT_TRUE(openings_of(ball()).empty());
    EXPECT_TRUE(is_sealed(ball()));
    EXPECT_FALSE(is_sealed(tube()));
}

TEST(GarmentOpenings, PiecesAreCounted)
{
    TriangleMesh far = ball();
    far.positions.array() += 2;
    const Pieces pieces = count_pieces(fixtures::joined(tube(), far));
    EXPECT_EQ(pieces.count, 2);
    EXPECT_NEAR(pieces.largest, 0.6, 0.05);
}

}  // namespace
