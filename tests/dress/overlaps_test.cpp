// SPDX-License-Identifier: GPL-3.0-or-later
#include "overlaps.h"

#include <gtest/gtest.h>

#include "fixtures.h"
#include "skin_weights.h"

namespace garmentfit {
namespace {

constexpr double k_radius = 0.1, k_spacing = 0.01;  // m

TriangleMesh ball(double x)
{
    const Vec3 centre(x, 0, 0), reach = Vec3::Constant(k_radius + 2 * k_spacing);
    return fixtures::polygonise([&](const Vec3& p) { return (p - centre).norm() - k_radius; }, centre - reach,
                                centre + reach, k_spacing);
}

/// A chest and an upper arm, balls with their middles so far apart; skins keep off each other beyond twice the radius.
struct ChestAndArm {
    TriangleMesh body;
    SkinWeights weights;

    explicit ChestAndArm(double apart)
    {
        const TriangleMesh chest = ball(0), arm = ball(apart);
        body = fixtures::joined(chest, arm);
        weights = fixtures::on_bone(thorax, chest.positions.rows());
        append(weights, fixtures::on_bone(lhumerus, arm.positions.rows()));
    }
    std::vector<Overlap> find(char near_cloth) const
    {
        return find_overlaps(body, weights, std::vector<char>(body.positions.rows(), near_cloth));
    }
};

TEST(Overlaps, NameTheTwoPartsAndHowDeepTheyEnterEachOther)
{
    const auto found = ChestAndArm(0.18).find(1);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].part, "chest");
    EXPECT_EQ(found[0].other, "left upper arm");
    EXPECT_NEAR(found[0].depth, 0.02, 2e-3);
}

TEST(Overlaps, AreNoneWherePartsOnlyComeNear) { EXPECT_TRUE(ChestAndArm(0.205).find(1).empty()); }

TEST(Overlaps, DoNotMatterFarFromCloth) { EXPECT_TRUE(ChestAndArm(0.18).find(0).empty()); }

TEST(Overlaps, OfAPartWithItselfDoNotCount)
{
    ChestAndArm d(0.18);
    d.weights = fixtures::on_bone(thorax, d.body.positions.rows());
    EXPECT_TRUE(d.find(1).empty());
}

}  // namespace
}  // namespace garmentfit
