// SPDX-License-Identifier: GPL-3.0-or-later
#include "tightness.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fixtures.h"

namespace garmentfit {
namespace {

/// Points round a bone, at this distance from it.
Positions tube(const Skeleton& skeleton, Bone bone, double radius)
{
    constexpr int k_rings = 10, k_round = 32;
    const Vec3 axis = skeleton.direction(bone), across = axis.unitOrthogonal(), third = axis.cross(across);
    Positions result(k_rings * k_round, 3);
    for (int i = 0; i < result.rows(); ++i) {
        const double angle = 2 * M_PI * (i % k_round) / k_round, along = (i / k_round + 0.5) / k_rings;
        result.row(i) = skeleton.head(bone) + along * skeleton.length(bone) * axis
            + radius * (std::cos(angle) * across + std::sin(angle) * third);
    }
    return result;
}

/// The triangles of such a tube.
Triangles tube_triangles()
{
    constexpr int k_rings = 10, k_round = 32;
    Triangles result(2 * (k_rings - 1) * k_round, 3);
    for (int i = 0; i < (k_rings - 1) * k_round; ++i) {
        const int next = i / k_round * k_round + (i + 1) % k_round;
        result.row(2 * i) << i, next, i + k_round;
        result.row(2 * i + 1) << next, next + k_round, i + k_round;
    }
    return result;
}

TEST(Tightness, NamesThePartAndTheGirthThatItLacks)
{
    const Skeleton skeleton = fixtures::person_skeleton({});
    const Positions rest = tube(skeleton, lfemur, 0.08), worn = tube(skeleton, lfemur, 0.1);
    const Edges edges = edges_of(tube_triangles());
    Tightness tightness(rest, edges, fixtures::on_bone(lfemur, rest.rows()), skeleton, 2);
    EXPECT_NEAR(tightness.largest_stretch(worn), 0.25, 1e-6);
    const auto tight = tightness.list_tight_parts(worn, 0.15, {});
    ASSERT_EQ(tight.size(), 1u);
    EXPECT_EQ(tight[0].garment, 2);
    EXPECT_EQ(tight[0].part, "left thigh");
    EXPECT_NEAR(tight[0].missing_girth, 2 * M_PI * 0.02, 1e-6);
    EXPECT_NEAR(tight[0].enlargement, 0.25, 1e-6);
    EXPECT_EQ(tightness.list_tight_parts_at_rest(worn, 0.15).size(), 1u);
    EXPECT_TRUE(tightness.list_tight_parts(worn, 0.3, {}).empty());
    tightness.set_rest(worn);
    EXPECT_NEAR(tightness.largest_stretch(worn), 0, 1e-9);
}

TEST(Tightness, CountsACaughtEdgeAsHalfStretched)
{
    const Skeleton skeleton = fixtures::person_skeleton({});
    const Positions rest = tube(skeleton, lfemur, 0.05), worn = tube(skeleton, lfemur, 0.1);  // twice as wide
    const Edges edges = edges_of(tube_triangles());
    const Tightness tightness(rest, edges, fixtures::on_bone(lfemur, rest.rows()), skeleton);
    EXPECT_NEAR(tightness.largest_stretch(worn), 0.5, 1e-6);
}

TEST(Slack, IsHowMuchWiderAGarmentIsThanWhatItGoesRound)
{
    const Skeleton skeleton = fixtures::person_skeleton({});
    const Positions thigh = tube(skeleton, lfemur, 0.08);
    const auto wider = slack(tube(skeleton, lfemur, 0.1), thigh, fixtures::on_bone(lfemur, thigh.rows()), skeleton);
    for (int p = 0; p < k_body_parts; ++p)
        EXPECT_NEAR(wider[p], p == part_of(lfemur) ? 0.25 : 0, 1e-9) << part_name(p);
}

TEST(GrowthLeft, IsWhatTheSkinUnderAGarmentStillLacks)
{
    const Skeleton skeleton = fixtures::person_skeleton({});
    const Positions thin = tube(skeleton, lfemur, 0.05), full = tube(skeleton, lfemur, 0.08);
    const auto growth
        = growth_left(tube(skeleton, lfemur, 0.055), thin, full, fixtures::on_bone(lfemur, thin.rows()), skeleton);
    for (int p = 0; p < k_body_parts; ++p)
        EXPECT_NEAR(growth[p], p == part_of(lfemur) ? 0.6 : 0, 1e-9) << part_name(p);
}

}  // namespace
}  // namespace garmentfit
