// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/closed_ends.h"

#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "fixtures.h"

namespace garmentfit {
namespace {

constexpr int k_around = 24, k_rows = 11;

/// A tube along y, with caps at its lower and upper end: none, a fan around a vertex, or a fan around a corner.
enum class Cap { none, around_centre, around_corner };

TriangleMesh tube(Cap lower, Cap upper, double x = 0, int around = k_around)
{
    TriangleMesh mesh { Positions(around * k_rows + 2, 3), Triangles(4 * around * k_rows, 3) };
    int f = 0;
    for (int i = 0; i < k_rows; ++i)
        for (int k = 0; k < around; ++k) {
            const double angle = 2 * std::numbers::pi * k / around;
            const int here = i * around + k, next = i * around + (k + 1) % around;
            mesh.positions.row(here) << x + 0.1 * std::sin(angle), 0.05 * i, 0.1 * std::cos(angle);
            if (i + 1 < k_rows) {
                mesh.triangles.row(f++) << here, next, here + around;
                mesh.triangles.row(f++) << next, next + around, here + around;
            }
        }
    for (const auto& [cap, row] : { std::pair { lower, 0 }, std::pair { upper, k_rows - 1 } }) {
        const int first = row * around, centre = around * k_rows + (row > 0);
        mesh.positions.row(centre) << x, 0.05 * row, 0;
        for (int k = 0; k < around && cap == Cap::around_centre; ++k)
            mesh.triangles.row(f++) << centre, first + (k + 1) % around, first + k;
        for (int k = 1; k + 1 < around && cap == Cap::around_corner; ++k)
            mesh.triangles.row(f++) << first, first + k + 1, first + k;
    }
    mesh.triangles.conservativeResize(f, 3);
    return mesh;
}

OpenedGarment opened(const TriangleMesh& mesh) { return open_ends({ mesh.positions, mesh.triangles }); }

TEST(ClosedEnds, AreOpenedHoweverTheirHolesWereFilled)
{
    const TriangleMesh open = tube(Cap::none, Cap::none);
    for (const Cap cap : { Cap::around_centre, Cap::around_corner })
        for (const bool is_lower : { true, false }) {
            const TriangleMesh capped = is_lower ? tube(cap, Cap::none) : tube(Cap::none, cap);
            const OpenedGarment result = opened(capped);
            EXPECT_EQ(result.closed_ends, 1);
            EXPECT_EQ(result.garment.triangles, open.triangles);
            EXPECT_EQ(result.garment.positions, capped.positions);
        }
}

TEST(ClosedEnds, OfAnOpenGarmentAreNone)
{
    const TriangleMesh open = tube(Cap::none, Cap::none);
    EXPECT_EQ(opened(open).closed_ends, 0);
    EXPECT_EQ(opened(open).garment.triangles, open.triangles);
}

TEST(ClosedEnds, OfTwoPiecesAreCountedTogether)
{
    const OpenedGarment result = opened(
        fixtures::joined(tube(Cap::around_centre, Cap::none, -0.15), tube(Cap::around_corner, Cap::none, 0.15)));
    EXPECT_EQ(result.closed_ends, 2);
}

TEST(ClosedEnds, OfSolidsStayClosed)
{
    for (const Cap cap : { Cap::around_centre, Cap::around_corner })
        for (const int around : { 4, 6, 24 })  // a block, a prism, a cylinder
            EXPECT_EQ(opened(tube(cap, cap, 0, around)).closed_ends, 0);
    const TriangleMesh ball = fixtures::polygonise([](const Vec3& p) { return p.norm() - 0.3; }, Vec3::Constant(-0.5),
                                                   Vec3::Constant(0.5), 0.1);
    EXPECT_EQ(opened(ball).closed_ends, 0);
}

}  // namespace
}  // namespace garmentfit
