// SPDX-License-Identifier: GPL-3.0-or-later
#include "closed_surface.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "fixtures.h"
#include "garmentfit/error.h"
#include "surface_measures.h"

namespace {

using namespace garmentfit;

TriangleMesh ball(double x)
{
    const Vec3 corner = Vec3::Constant(0.6);
    TriangleMesh mesh = fixtures::polygonise([](const Vec3& p) { return p.norm() - 0.5; }, Vec3(-corner), corner, 0.1);
    mesh.positions.col(0).array() += x;
    return mesh;
}

/// Two balls with a gap.
TriangleMesh parts()
{
    TriangleMesh both = ball(0);
    const TriangleMesh second = ball(1.02);
    const Eigen::Index n = both.positions.rows(), m = both.triangles.rows();
    both.positions.conservativeResize(n + second.positions.rows(), 3);
    both.positions.bottomRows(second.positions.rows()) = second.positions;
    both.triangles.conservativeResize(m + second.triangles.rows(), 3);
    both.triangles.bottomRows(second.triangles.rows()) = second.triangles.array() + int(n);
    return both;
}

TEST(JoinParts, WrapsPartsAsOneClosedSurface)
{
    const auto joined = join_parts(parts(), Gaps::wide);
    ASSERT_TRUE(joined);
    EXPECT_NEAR(volume(*joined), 2 * volume(ball(0)), 0.1);
}

TEST(JoinParts, StopsWhenAsked)
{
    EXPECT_THROW(join_parts(parts(), Gaps::narrow, Progress([](double, std::string_view) { return false; })),
                 Cancelled);
    EXPECT_THROW(join_parts(parts(), Gaps::narrow, Progress().until(Deadline::in(1e-9))), TimeLimitReached);
}

TEST(Slow, JoinPartsGivesUpWhatHasFarMoreSurfaceThanABody)
{
    constexpr int sheets = 8;
    TriangleMesh stack { Positions(4 * sheets, 3), Triangles(2 * sheets, 3) };
    for (int i = 0; i < sheets; ++i) {
        const double z = double(i) / sheets;
        stack.positions.middleRows(4 * i, 4) << 0, 0, z, 1, 0, z, 1, 1, z, 0, 1, z;
        stack.triangles.middleRows(2 * i, 2) << 4 * i, 4 * i + 1, 4 * i + 2, 4 * i, 4 * i + 2, 4 * i + 3;
    }
    double done = 0;
    const Progress progress([&](double fraction, std::string_view) {
        done = std::max(done, fraction);
        return true;
    });
    EXPECT_FALSE(join_parts(stack, Gaps::narrow, progress));
    EXPECT_EQ(done, 1);
}

}  // namespace
