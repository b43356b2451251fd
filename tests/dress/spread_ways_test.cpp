// SPDX-License-Identifier: GPL-3.0-or-later
#include "spread_ways.h"

#include <gtest/gtest.h>

#include "exact_crossings.h"
#include "fixtures.h"
#include "topology.h"

namespace garmentfit {
namespace {

constexpr double k_side = 0.2;  // m

TriangleMesh flat_sheet(int n, double height) { return fixtures::flat(n, k_side / (n - 1), { 0, height, 0 }); }

/// A way up for what lies within 1 cm of the middle of the sheets.
Positions push_up(const Positions& places, double way)
{
    const Vec3 middle = (places.colwise().minCoeff() + places.colwise().maxCoeff()) / 2;
    Positions ways = Positions::Zero(places.rows(), 3);
    for (Eigen::Index v = 0; v < places.rows(); ++v)
        if ((places.row(v).transpose() - middle).norm() < 0.01)
            ways(v, 1) = way;
    return ways;
}

TEST(SpreadWays, TakesThemWholeAndFadesToNothing)
{
    const Positions places = flat_sheet(81, 0).positions;
    const Positions ways = push_up(places, 0.004), spread = spread_ways(places, ways, 0.05);
    const Vec3 middle = places.colwise().mean();
    for (Eigen::Index v = 0; v < places.rows(); ++v) {
        const double apart = (places.row(v).transpose() - middle).norm();
        if (ways.row(v).norm() > 0) {
            EXPECT_LT((spread.row(v) - ways.row(v)).norm(), 1e-12);
        } else if (apart > 0.01 + 0.05) {
            EXPECT_EQ(spread.row(v).norm(), 0) << apart;
        } else if (apart < 0.02) {
            EXPECT_GT(spread.row(v).norm(), 0.002) << apart;
        }
    }
}

TEST(SpreadWays, MovesNothingWithoutAWay)
{
    const Positions places = flat_sheet(5, 0).positions;
    EXPECT_EQ(spread_ways(places, Positions::Zero(25, 3), 1), Positions::Zero(25, 3));
}

TEST(SpreadWays, KeepsTheOrderOfSheetsInUnlikeTriangles)
{
    const TriangleMesh sheets
        = fixtures::joined(fixtures::joined(flat_sheet(41, 0), flat_sheet(34, 0.0005)), flat_sheet(29, 0.006));
    Positions ways = push_up(sheets.positions, 0.012);
    ways.bottomRows(34 * 34 + 29 * 29)
        .setZero();  // the lowest sheet alone has to move, by more than all others are away
    ASSERT_GT(ways.norm(), 0);
    const Positions moved = sheets.positions + spread_ways(sheets.positions, ways, 0.04);
    const TriangleMesh after { moved, sheets.triangles };
    EXPECT_TRUE(find_self_crossings(after, edges_of(after.triangles), TriangleTree(after)).empty());
    const TriangleMesh torn { sheets.positions + ways, sheets.triangles };
    EXPECT_FALSE(find_self_crossings(torn, edges_of(torn.triangles), TriangleTree(torn)).empty());
}

}  // namespace
}  // namespace garmentfit
