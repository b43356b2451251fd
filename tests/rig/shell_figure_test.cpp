// SPDX-License-Identifier: GPL-3.0-or-later
#include "shell_figure.h"

#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "fixtures.h"
#include "garmentfit/rig_body.h"

namespace {

using namespace garmentfit;
using namespace garmentfit::fixtures;

constexpr double k_unit = 1.0 / 16;  // m
constexpr double k_clearly_human = 0.6;  // below it, hosts warn

/// A box of six sides; `split` gives each side its own corners, as files with pictures on blocks do.
TriangleMesh block(const Vec3& middle, const Vec3& size, bool split)
{
    const int sides[6][4] { { 0, 1, 3, 2 }, { 4, 6, 7, 5 }, { 0, 4, 5, 1 },
                            { 2, 3, 7, 6 }, { 0, 2, 6, 4 }, { 1, 5, 7, 3 } };
    TriangleMesh mesh { Positions(split ? 24 : 8, 3), Triangles(12, 3) };
    const auto corner = [&](int c) -> Vec3 {
        return middle + 0.5 * Vec3(c & 4 ? 1 : -1, c & 2 ? 1 : -1, c & 1 ? 1 : -1).cwiseProduct(size);
    };
    for (int s = 0; s < 6; ++s) {
        int rows[4];
        for (int k = 0; k < 4; ++k) {
            rows[k] = split ? 4 * s + k : sides[s][k];
            mesh.positions.row(rows[k]) = k_unit * corner(sides[s][k]);
        }
        mesh.triangles.row(2 * s) << rows[0], rows[1], rows[2];
        mesh.triangles.row(2 * s + 1) << rows[0], rows[2], rows[3];
    }
    return mesh;
}

enum class Arms { down, forwards, out };

struct Blocks {
    Arms arms = Arms::down;
    double gap = 0;  ///< between parts
    double sunk = 0;  ///< the head into the chest, and as far forwards
    bool split = true, head = true, has_pack = false, has_hat = false, has_bow = false,
         has_parted_trunk = false;  ///< chest, belly and hips
};

/// 32 units tall.
TriangleMesh figure_of_blocks(const Blocks& b)
{
    TriangleMesh mesh;
    const auto add = [&](const Vec3& middle, const Vec3& size) { mesh = joined(mesh, block(middle, size, b.split)); };
    if (b.has_parted_trunk)
        for (const double y : { 14, 18, 22 })
            add({ 0, y, 0 }, { 8, 4 - b.gap, 4 });
    else
        add({ 0, 18, 0 }, { 8, 12, 4 });
    if (b.head)
        add({ 0, 28 + b.gap - b.sunk, b.sunk }, { 8, 8, 8 });
    for (const double s : { 1, -1 }) {
        add({ s * (2 + b.gap / 2), 6 - b.gap, 0 }, { 4, 12, 4 });
        const double x = s * (6 + b.gap);
        if (b.arms == Arms::down)
            add({ x, 18, 0 }, { 4, 12, 4 });
        else if (b.arms == Arms::forwards)
            add({ x, 22, 4 }, { 4, 4, 12 });
        else
            add({ s * (10 + b.gap), 22, 0 }, { 12, 4, 4 });
    }
    if (b.has_pack)
        add({ 0, 18, -4 }, { 6, 8, 3 });
    if (b.has_bow)  // about the lower half of an arm
        add({ 6, 13, 0 }, { 3, 6, 30 });
    if (b.has_hat) {
        add({ 0, 28, 0 }, { 9, 9, 9 });
        add({ 0, 33, 0 }, { 12, 1, 12 });
    }
    return mesh;
}

TEST(ShellFigure, BlocksAreHeadTrunkArmsAndLegsHoweverTheyTouch)
{
    for (const Blocks& b : { Blocks {}, Blocks { .gap = 0.5 }, Blocks { .split = false }, Blocks { .arms = Arms::out },
                             Blocks { .arms = Arms::forwards }, Blocks { .has_pack = true }, Blocks { .has_hat = true },
                             Blocks { .gap = 0.2, .has_pack = true, .has_hat = true },
                             Blocks { .gap = 0.5, .has_parted_trunk = true } }) {
        SCOPED_TRACE("arms " + std::to_string(int(b.arms)) + " gap " + std::to_string(b.gap) + " pack "
                     + std::to_string(b.has_pack) + " hat " + std::to_string(b.has_hat));
        const std::optional<ShellFigure> figure = shell_figure(figure_of_blocks(b));
        ASSERT_TRUE(figure);
        EXPECT_LT(figure->cost, 3);
        const Vec3 wrist = b.arms == Arms::down ? Vec3(6, 15, 0)
            : b.arms == Arms::out               ? Vec3(13, 22, 0)
                                                : Vec3(6, 22, 7);
        EXPECT_LT((figure->joints.arms[0].end - k_unit * wrist).norm(), 2 * k_unit)
            << figure->joints.arms[0].end / k_unit;
        EXPECT_LT((figure->joints.arms[0].root - k_unit * Vec3(6, 22, 0)).norm(), 2.1 * k_unit)
            << figure->joints.arms[0].root / k_unit;
        EXPECT_LT((figure->joints.legs[1].root - k_unit * Vec3(-2, 12, 0)).norm(), k_unit);
        EXPECT_LT((figure->joints.legs[1].end - k_unit * Vec3(-2, 1, 0)).norm(), k_unit);
    }
}

TEST(ShellFigure, AHeadMayBeSunkIntoTheChest)
{
    const std::optional<ShellFigure> figure = shell_figure(figure_of_blocks({ .sunk = 5 }));
    ASSERT_TRUE(figure);
    EXPECT_LT(figure->cost, 3);
    EXPECT_NEAR(figure->joints.crown.y(), 27 * k_unit, 1e-9);
}

TEST(ShellFigure, WhatIsHeldInOneHandIsNoArm)
{
    const std::optional<ShellFigure> figure = shell_figure(figure_of_blocks({ .gap = 0.5, .has_bow = true }));
    ASSERT_TRUE(figure);
    EXPECT_LT(figure->cost, 5);
    for (const LimbJoints& arm : figure->joints.arms) {
        EXPECT_NEAR(arm.tip.y(), 12 * k_unit, 0.1 * k_unit);
        EXPECT_NEAR(arm.tip.z(), 0, 0.1 * k_unit);
    }
}

TEST(ShellFigure, OneShellIsNone)
{
    EXPECT_FALSE(shell_figure(capsule_person().mesh));
    EXPECT_FALSE(shell_figure(block({ 0, 18, 0 }, { 8, 12, 4 }, true)));
}

TEST(Slow, AFigureOfBlocksIsRiggedWithAWarningAndItsBlocksStayStiff)
{
    const TriangleMesh mesh = figure_of_blocks({});
    const Rig rig = rig_body(make_body(mesh.positions, mesh.triangles));
    EXPECT_LT(rig.human_probability, k_clearly_human);
    EXPECT_GT(rig.front.z(), 0.99);  // nothing shows it; files face +z
    EXPECT_GT(rig.skeleton.tail(lclavicle).x(), 0);
    for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v) {
        const Vec3 p = mesh.positions.row(v) / k_unit;
        const int bone = rig.weights.bones(v, 0);
        if (p.x() > 4.5) {  // beyond the trunk
            EXPECT_TRUE(bone == lhumerus || bone == lradius || bone == lclavicle) << bone_name(bone) << p.transpose();
        } else if (p.y() < 0.5) {
            EXPECT_TRUE(bone == ltibia || bone == rtibia) << bone_name(bone);
        }
    }
    EXPECT_NEAR(rig.weights.weights.rowwise().sum().minCoeff(), 1, 1e-9);
    expect_invalid([&] { rig_body(make_body(mesh.positions, mesh.triangles), { .humanlike = Humanlike::strict }); },
                   "body");
}

}  // namespace
