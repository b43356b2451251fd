// SPDX-License-Identifier: GPL-3.0-or-later
#include "front_shape.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tuning.h"

namespace {

using namespace garmentfit;

// A tube as wide as 0.4 m, 0.5 m high, top at 0; patches every 15 mm. Its middle line moves by `shift(depth)` along z.
template <class Shift>
std::vector<ClothPatch> tube(const Shift& shift)
{
    std::vector<ClothPatch> patches;
    for (double depth = 0; depth < 0.5; depth += 0.015)
        for (double angle = 0; angle < 2 * M_PI; angle += 0.08) {
            const Vec3 out(std::sin(angle), 0, std::cos(angle));
            const Vec3 centre = Vec3(0.2 * out.x(), -depth, 0.13 * out.z() + shift(depth));
            patches.push_back({ centre.cast<float>(), (2e-4 * out).cast<float>() });
        }
    return patches;
}

FrontShape shape_of(const std::vector<ClothPatch>& cloth, const Vec3& front)
{
    return front_shape(cloth, {}, {}, front);
}

TEST(FrontShape, ASeatLiesBehindTheRim)
{
    const auto skirt = tube([](double depth) { return depth > 0.1 ? -0.01 : 0.0; });
    EXPECT_NEAR(shape_of(skirt, Vec3::UnitZ()).seat, -0.5, 0.1) << "twice 1 cm on a width of 40 cm";
    EXPECT_NEAR(shape_of(skirt, -Vec3::UnitZ()).seat, 0.5, 0.1);
    EXPECT_NEAR(shape_of(tube([](double) { return 0.0; }), Vec3::UnitZ()).seat, 0, 0.1);
}

TEST(FrontShape, ARolledWaistbandSaysNoMoreThanASeat)
{
    const auto trousers = tube([](double depth) { return depth > 0.1 ? 0.08 : 0.0; });
    EXPECT_EQ(shape_of(trousers, Vec3::UnitZ()).seat, k_max_seat_shape) << "not 4";
    EXPECT_EQ(shape_of(trousers, -Vec3::UnitZ()).seat, -k_max_seat_shape);
}

TEST(FrontShape, ATopAndBottomBehindTheMiddleAreABow)
{
    const auto shirt = tube([](double depth) { return depth < 0.08 || depth > 0.42 ? -0.04 : 0.0; });
    EXPECT_NEAR(shape_of(shirt, Vec3::UnitZ()).bow, -1, 0.2);
    EXPECT_NEAR(shape_of(shirt, -Vec3::UnitZ()).bow, 1, 0.2);
}

TEST(FrontShape, ANecklineLeavesLessClothInFront)
{
    auto shirt = tube([](double) { return 0.0; });
    std::erase_if(shirt, [](const ClothPatch& patch) {
        return patch.centre.z() > 0.05f && patch.centre.y() > -0.1f && std::abs(patch.centre.x()) < 0.06f;
    });
    EXPECT_GT(shape_of(shirt, Vec3::UnitZ()).bare, 0.2);
    EXPECT_LT(shape_of(shirt, -Vec3::UnitZ()).bare, -0.2);
}

TEST(FrontShape, ThighsMakeTheLapBroaderThanTheBack)
{
    auto trousers = tube([](double) { return 0.0; });
    for (ClothPatch& patch : trousers)
        if (patch.centre.z() < 0)
            patch.centre.x() *= 0.8f;
    EXPECT_GT(shape_of(trousers, Vec3::UnitZ()).lap, 0.5);
    EXPECT_LT(shape_of(trousers, -Vec3::UnitZ()).lap, -0.5);
}

// Rim of the tube, `drop` lower in front than behind, m.
Opening slanted_waist(double drop)
{
    Opening waist;
    waist.girth = 1;
    waist.rim.resize(64, 3);
    for (int i = 0; i < 64; ++i) {
        const double angle = i * M_PI / 32;
        waist.rim.row(i) << 0.2 * std::sin(angle), -0.5 * drop * (1 + std::cos(angle)), 0.13 * std::cos(angle);
    }
    return waist;
}

TEST(FrontShape, AWaistIsHigherBehind)
{
    const auto trousers = tube([](double) { return 0.0; });
    const Opening waist = slanted_waist(0.02);
    EXPECT_NEAR(front_shape(trousers, { waist }, {}, Vec3::UnitZ()).rise, 0.5, 0.1) << "2 cm on a width of 40 cm";
    EXPECT_NEAR(front_shape(trousers, { waist }, {}, -Vec3::UnitZ()).rise, -0.5, 0.1);
}

TEST(FrontShape, ASeatIsFoundBelowASlantedWaist)
{
    auto shorts = tube([](double depth) { return depth > 0.16 ? -0.01 : 0.0; });
    std::erase_if(shorts,
                  [](const ClothPatch& patch) { return patch.centre.y() > -0.04f * (1 + patch.centre.z() / 0.13f); });
    EXPECT_NEAR(front_shape(shorts, { slanted_waist(0.08) }, {}, Vec3::UnitZ()).seat, -0.5, 0.15)
        << "twice 1 cm on a width of 40 cm, though the uppermost cloth is all behind";
}

// The tube is a dress, worn by a body with its chest 10 cm and its hips 40 cm below the top, and shoulders of 30 cm.
TEST(FrontShape, ABustIsInFrontOfASeat)
{
    Skeleton worn;
    worn.root = { 0, -0.4, 0 };
    for (const int bone : { lhipjoint, rhipjoint })
        worn.tails[bone] = worn.root;
    worn.tails[upperback] = { 0, -0.1, 0 };
    worn.tails[lclavicle] = { 0.15, 0, 0 };
    worn.tails[rclavicle] = { -0.15, 0, 0 };
    const auto dress = tube([](double depth) { return depth < 0.25 ? 0.02 : -0.01; });
    EXPECT_NEAR(profile_of(dress, worn, Vec3::UnitZ()), 2, 0.2) << "twice 3 cm on shoulders of 30 cm";
    EXPECT_NEAR(profile_of(dress, worn, -Vec3::UnitZ()), -2, 0.2);
    worn.root.y() = -0.8;
    for (const int bone : { lhipjoint, rhipjoint })
        worn.tails[bone] = worn.root;
    EXPECT_EQ(profile_of(dress, worn, Vec3::UnitZ()), 0) << "it ends above the seat";
}

}  // namespace
