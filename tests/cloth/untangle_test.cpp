// SPDX-License-Identifier: GPL-3.0-or-later
#include "untangle.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "exact_crossings.h"
#include "fixtures.h"
#include "garmentfit/certificate.h"

namespace {

using namespace garmentfit;
using namespace garmentfit::fixtures;

/// 20 by 20 cm, vertices 1 cm apart.
TriangleMesh sheet(const std::function<double(double, double)>& height) { return fixtures::sheet(21, 0.01, height); }

/// A flat sheet, and one above it that passes through it by this depth in the middle.
TriangleMesh dipping(double depth)
{
    return joined(sheet([](double, double) { return 0; }), sheet([&](double x, double z) {
                      const double off = std::hypot(x - 0.103, z - 0.097);
                      return 0.004 - (0.004 + depth) * std::exp(-off * off / (2 * 0.02 * 0.02));
                  }));
}

TEST(Untangle, LeavesClothThatDoesNotCrossItselfAsItIs)
{
    const TriangleMesh apart = dipping(-0.002);
    ASSERT_TRUE(self_crossings(apart).empty());
    EXPECT_EQ(untangle(apart).positions, apart.positions);
}

TEST(Untangle, FindsTheSameCrossingsWithRenewedTrees)
{
    TriangleMesh cloth = dipping(0.001);
    const Edges edges = edges_of(cloth.triangles);
    SelfCrossingSearch search(cloth.triangles, edges);
    std::size_t found = 0;
    for (const double depth : { 0.001, 0.02, 0.006, -0.002 }) {
        cloth.positions = dipping(depth).positions;
        const std::vector<Crossing> crossings = search.find(cloth.positions);
        EXPECT_EQ(crossings, find_self_crossings(cloth, edges, TriangleTree(cloth))) << depth;
        found += crossings.size();
    }
    EXPECT_GT(found, 100u);
    for (const double lift : { 0.02, -0.02, 0. }) {  // of some vertices only
        cloth.positions.middleRows(cloth.positions.rows() / 3, 50).col(1).array() += lift;
        EXPECT_EQ(search.find(cloth.positions), find_self_crossings(cloth, edges, TriangleTree(cloth))) << lift;
    }
}

TEST(Untangle, CountsWhatTouchesAndLeavesOutWhatHasNoArea)
{
    // an edge of the second triangle ends on the first one; the third one is a line through it
    const TriangleMesh touching { Positions { { 0, 0, 0 },
                                              { 1, 0, 0 },
                                              { 0, 0, 1 },
                                              { 0.2, 0, 0.2 },
                                              { 0.2, 1, 0.2 },
                                              { 0.3, 1, 0.2 },
                                              { 0.1, -1, 0.1 },
                                              { 0.1, 0, 0.1 },
                                              { 0.1, 1, 0.1 } },
                                  Triangles { { 0, 1, 2 }, { 3, 4, 5 }, { 6, 7, 8 } } };
    const Edges edges = edges_of(touching.triangles);
    const std::vector<Crossing> crossings = SelfCrossingSearch(touching.triangles, edges).find(touching.positions);
    EXPECT_EQ(crossings, find_self_crossings(touching, edges, TriangleTree(touching)));
    EXPECT_FALSE(crossings.empty());
}

TEST(Untangle, PartsASheetThatDipsThroughAnother)
{
    const TriangleMesh tangled = dipping(0.006);
    ASSERT_FALSE(self_crossings(tangled).empty());
    EXPECT_TRUE(self_crossings({ untangle(tangled).positions, tangled.triangles }).empty());
}

TEST(Untangle, PartsACornerThatSticksThroughASheet)
{
    TriangleMesh corner = sheet([](double x, double z) { return 0.5 * (x + z) - 0.0111; });
    corner.positions.col(0).array() += 0.0513;
    corner.positions.col(2).array() += 0.0537;
    const TriangleMesh tangled = joined(sheet([](double, double) { return 0; }), corner);
    ASSERT_FALSE(self_crossings(tangled).empty());
    EXPECT_TRUE(self_crossings({ untangle(tangled).positions, tangled.triangles }).empty());
}

TEST(Untangle, MovesNothingFarFromATangle)
{
    const TriangleMesh tangled = dipping(0.003);
    const Positions result = untangle(tangled).positions;
    for (Eigen::Index v = 0; v < result.rows(); ++v)
        if (std::hypot(tangled.positions(v, 0) - 0.103, tangled.positions(v, 2) - 0.097) > 0.1) {
            EXPECT_EQ(result.row(v), tangled.positions.row(v));
        }
    EXPECT_LT((result - tangled.positions).rowwise().norm().maxCoeff(), 0.01);
}

TEST(Untangle, MakesNoNewCrossingWhereATangleDoesNotComeApartAndPartsTheRest)
{
    const TriangleMesh rings = joined(
        polygonise([](const Vec3& p) { return std::hypot(std::hypot(p.x(), p.y()) - 0.1, p.z()) - 0.06; },
                   Vec3::Constant(-0.2), Vec3::Constant(0.2), 0.055),
        polygonise([](const Vec3& p) { return std::hypot(std::hypot(p.x() - 0.03, p.z()) - 0.1, p.y()) - 0.06; },
                   Vec3::Constant(-0.25), Vec3::Constant(0.25), 0.055));  // linked, too thick to be separated
    TriangleMesh dip = dipping(0.004);
    dip.positions.col(1).array() += 1;
    const TriangleMesh both = joined(rings, dip);
    const UntangleResult result = untangle(both);
    const std::vector<Crossing> given = self_crossings(both);
    EXPECT_FALSE(result.left.empty());
    EXPECT_LT(result.left.size(), given.size());
    EXPECT_TRUE(std::includes(given.begin(), given.end(), result.left.begin(), result.left.end()));
    EXPECT_EQ(result.left, self_crossings({ result.positions, both.triangles }));
    EXPECT_TRUE(self_crossings({ result.positions.bottomRows(dip.positions.rows()), dip.triangles }).empty());
}

TEST(Untangle, GoesTheSameWayInAnyFrame)
{
    const TriangleMesh tangled = dipping(0.006);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
    const Positions moved = tangled.positions * turn.transpose();
    EXPECT_LT((untangle({ moved, tangled.triangles }).positions - untangle(tangled).positions * turn.transpose())
                  .rowwise()
                  .norm()
                  .maxCoeff(),
              1e-3);
}

}  // namespace
