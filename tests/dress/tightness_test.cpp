// SPDX-License-Identifier: GPL-3.0-or-later
#include "tightness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "fixtures.h"
#include "garmentfit/fit_map.h"

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
    Tightness tightness(rest, edges, fixtures::on_bone(lfemur, rest.rows()), skeleton, 0.15, 2);
    EXPECT_NEAR(tightness.needed_size(worn, 0), 1.25, 1e-6);
    EXPECT_NEAR(tightness.needed_size(worn, 1), 1.25 / 1.15, 1e-6);
    const auto tight = tightness.list_tight_parts(worn, 1, {});
    ASSERT_EQ(tight.size(), 1u);
    EXPECT_EQ(tight[0].garment, 2);
    EXPECT_EQ(tight[0].part, "left thigh");
    EXPECT_NEAR(tight[0].missing_girth, 2 * M_PI * 0.02, 1e-6);
    EXPECT_NEAR(tight[0].enlargement, 0.25, 1e-6);
    EXPECT_EQ(tightness.list_tight_parts_at_rest(worn).size(), 1u);
    EXPECT_TRUE(tightness.list_tight_parts(worn, 2, {}).empty());
    tightness.set_rest(worn);
    EXPECT_NEAR(tightness.needed_size(worn, 0), 1, 1e-9);
}

TEST(Tightness, NamesNoPartThatLacksNoGirth)
{
    const Skeleton skeleton = fixtures::person_skeleton({});
    const Positions rest = tube(skeleton, lfemur, 0.08), worn = tube(skeleton, lfemur, 0.1);
    const Edges edges = edges_of(tube_triangles());
    const Tightness tightness(rest, edges, fixtures::on_bone(lfemur, rest.rows()), skeleton, 0.15);
    PerPart growth {};
    for (double& share : growth)
        share = -0.1;
    const auto tight = tightness.list_tight_parts(worn, 1, growth);
    ASSERT_EQ(tight.size(), 1u);
    EXPECT_NEAR(tight[0].missing_girth, 2 * M_PI * 0.01, 1e-6);
    for (double& share : growth)
        share = -0.25;  // what it is drawn out by is thinner in the full body
    EXPECT_TRUE(tightness.list_tight_parts(worn, 1, growth).empty());
}

TEST(Tightness, CountsACaughtEdgeAsHalfStretched)
{
    const Skeleton skeleton = fixtures::person_skeleton({});
    const Positions rest = tube(skeleton, lfemur, 0.05), worn = tube(skeleton, lfemur, 0.1);  // twice as wide
    const Edges edges = edges_of(tube_triangles());
    const Tightness tightness(rest, edges, fixtures::on_bone(lfemur, rest.rows()), skeleton, 0.15);
    EXPECT_NEAR(tightness.needed_size(worn, 0), 1.5, 1e-6);
}

// literature: [kirk_1966_extensibility], pressure is tension over radius.
TEST(PartLoads, AreTheStretchRoundAPartAndThePressureThatFollows)
{
    const Skeleton skeleton = fixtures::person_skeleton({});
    const Positions rest = tube(skeleton, lfemur, 0.08), worn = tube(skeleton, lfemur, 0.1);
    WornGarment leggings { { rest, tube_triangles() }, worn, {} };
    leggings.fabric = Fabric::swimwear;
    const auto loads = part_loads(skeleton, fixtures::on_bone(lfemur, worn.rows()), worn, leggings);
    ASSERT_EQ(loads.size(), 1u);
    EXPECT_EQ(loads[0].part, "left thigh");
    EXPECT_NEAR(loads[0].girth, 2 * M_PI * 0.1, 1e-9);
    EXPECT_NEAR(loads[0].stretch, 0.25, 1e-6);
    EXPECT_NEAR(loads[0].pressure, material_of(Fabric::swimwear).stretch_stiffness * 0.25 / 0.1, 1e-3);
    leggings.rest.warps = Warps::Ones(leggings.rest.triangles.rows(), 2);  // then the weft goes round
    EXPECT_NEAR(part_loads(skeleton, fixtures::on_bone(lfemur, worn.rows()), worn, leggings)[0].pressure,
                2 * 0.45 / 1.45 * material_of(Fabric::swimwear).stretch_stiffness * 0.25 / 0.1, 1e-3);
    leggings.positions = rest;
    EXPECT_EQ(part_loads(skeleton, fixtures::on_bone(lfemur, worn.rows()), worn, leggings)[0].pressure, 0);
}

TEST(Tightness, OfAKnitCountsEdgesThatAreStretchedAsFarAsItGives)
{
    const Skeleton skeleton = fixtures::person_skeleton({});
    const Positions rest = tube(skeleton, lfemur, 0.06), worn = tube(skeleton, lfemur, 0.1);  // by two thirds
    const Edges edges = edges_of(tube_triangles());
    const Tightness rib(rest, edges, fixtures::on_bone(lfemur, rest.rows()), skeleton, 0.5);
    EXPECT_EQ(rib.list_tight_parts_at_rest(worn).size(), 1u) << "two thirds are more than it gives";
    EXPECT_NEAR(rib.needed_size(worn, 0), 5. / 3, 1e-6);
}

TEST(Tightness, LetsNecklinesGiveMoreThanTheFabric)
{
    const Skeleton skeleton = fixtures::person_skeleton({});
    for (const auto& [bone, radius, is_tight] :
         { std::tuple(upperneck, 0.06, false), std::tuple(upperneck, 0.08, true), std::tuple(lfemur, 0.06, true) }) {
        const Positions rest = tube(skeleton, bone, 0.05), worn = tube(skeleton, bone, radius);
        const Edges edges = edges_of(tube_triangles());
        const Tightness tightness(rest, edges, fixtures::on_bone(bone, rest.rows()), skeleton, 0.15);
        EXPECT_EQ(!tightness.list_tight_parts_at_rest(worn).empty(), is_tight) << bone << " " << radius;
        EXPECT_EQ(tightness.needed_size(worn, 1) > 1, is_tight) << bone << " " << radius;
    }
}

/// Where every other vertex of a tube round a bone is turned about it by a share of the way to the next one, so that its
/// edges are long and short in turns.
Positions with_uneven_edges(Positions tube, const Skeleton& skeleton, Bone bone, double share)
{
    const Vec3 axis = skeleton.direction(bone);
    for (int i = 0; i < tube.rows(); i += 2) {
        const Vec3 out = Vec3(tube.row(i)) - skeleton.head(bone), along = out.dot(axis) * axis;
        tube.row(i) = skeleton.head(bone) + along + Eigen::AngleAxisd(share * 2 * M_PI / 32, axis) * (out - along);
    }
    return tube;
}

TEST(Tightness, AtRestCountsEdgesByTheirLength)
{
    const Skeleton skeleton = fixtures::person_skeleton({});
    const Positions even = tube(skeleton, lfemur, 0.1), rest = with_uneven_edges(even, skeleton, lfemur, 0.98);
    Edges round(even.rows(), 2);  // in turns .02 and 1.98 of the mean: a hundredth of the length is short edges
    for (int i = 0; i < round.rows(); ++i)
        round.row(i) << i, i / 32 * 32 + (i + 1) % 32;
    const SkinWeights weights = fixtures::on_bone(lfemur, rest.rows());
    const Tightness tightness(rest, round, weights, skeleton, 0.15);
    const Positions worn
        = with_uneven_edges(even, skeleton, lfemur, 0.96);  // short edges twice as long, others as long
    EXPECT_TRUE(tightness.list_tight_parts_at_rest(worn).empty());
    EXPECT_EQ(
        tightness.list_tight_parts_at_rest(with_uneven_edges(tube(skeleton, lfemur, 0.12), skeleton, lfemur, 0.98))
            .size(),
        1u)
        << "all are stretched by a fifth";
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
