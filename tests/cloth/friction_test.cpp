// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloth_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fixtures.h"

// Dry friction that remembers where contacts stick.

namespace {

using namespace garmentfit;
using namespace garmentfit::fixtures;

constexpr double k_friction = 0.4;

ClothOptions with_friction()
{
    ClothOptions options;
    options.friction = k_friction;
    return options;
}

/// Under gravity and full friction, over an obstacle that stands still.
MotionStep hanging_step(const Positions& obstacle, int iterations)
{
    MotionStep step;
    step.obstacle_target = &obstacle;
    step.gravity = k_gravity;
    step.friction_fraction = 1;
    step.contact_stiffness = k_settling_contact_stiffness;
    step.iterations = iterations;
    return step;
}

TriangleMesh tilted(TriangleMesh mesh, double angle)
{
    mesh.positions = (mesh.positions * Eigen::AngleAxisd(-angle, Vec3::UnitZ()).toRotationMatrix().transpose()).eval();
    return mesh;
}

/// A sheet of 16 cm on a plane that falls off along +x.
class InclinedPlane {
public:
    explicit InclinedPlane(double angle) :
        downhill_(std::cos(angle), -std::sin(angle), 0), plane_(tilted(flat(13, 0.1, Vec3(-0.6, 0, -0.6)), angle)),
        sheet_(tilted(flat(9, 0.02, Vec3(-0.08, 0.0024, -0.08)), angle)),
        motion_({ sheet_.positions, sheet_.triangles }, sheet_.positions, plane_, with_friction())
    {
    }

    void go_on(int steps, double time_step, double velocity_kept)
    {
        MotionStep step = hanging_step(plane_.positions, 40);
        step.time_step = time_step;
        step.velocity_kept = velocity_kept;
        for (int i = 0; i < steps; ++i)
            motion_.advance(step);
    }

    /// Of the sheet's middle, m.
    double way() const { return (motion_.cloth() - sheet_.positions).colwise().mean().dot(downhill_.transpose()); }

private:
    Vec3 downhill_;
    TriangleMesh plane_, sheet_;
    ClothMotion motion_;
};

TEST(Friction, HoldsASheetOnASlopeBelowTheAngleOfFriction)
{
    InclinedPlane below(std::atan(0.9 * k_friction));
    below.go_on(100, 0.02, 0.3);
    const double at_rest = below.way();
    EXPECT_LT(at_rest, 1e-3);
    below.go_on(1500, 0.02, 0.3);  // half a minute
    EXPECT_NEAR(below.way(), at_rest, 1e-5);
}

// [coulomb_1785_machines]: a = g (sin a - mu cos a)
TEST(Friction, LetsASheetSlideDownASteeperSlopeAsCoulombSays)
{
    for (const double angle : { 0.6, 0.9 }) {
        constexpr double time_step = 0.002;
        InclinedPlane above(angle);
        above.go_on(50, time_step, 1);
        const double first = above.way();
        above.go_on(50, time_step, 1);
        const double second = above.way();
        above.go_on(50, time_step, 1);
        const double third = above.way(), acceleration = (third - 2 * second + first) / std::pow(50 * time_step, 2);
        const double expected = k_gravity * (std::sin(angle) - k_friction * std::cos(angle));
        EXPECT_NEAR(acceleration / expected, 1, 0.05) << angle << " rad";
    }
}

constexpr double k_drum = 0.06, k_short_end = 0.15, k_pitch = 0.01;  // m: radius; length that hangs; of the mesh

/// A strip over a drum about the z axis, one end longer than the other. Its shape is that of a string.
class StripOverDrum {
public:
    /// @param long_end  m
    explicit StripOverDrum(double long_end) :
        drum_(drum()), strip_(strip(long_end)),
        motion_({ strip_.positions, strip_.triangles }, strip_.positions, drum_, with_friction())
    {
    }

    void go_on(int steps)
    {
        MotionStep step = hanging_step(drum_.positions, 100);
        step.velocity_kept = 0.3;
        for (int i = 0; i < steps; ++i)
            motion_.advance(step);
    }

    /// Of the end of the long side, m.
    double way_down() const
    {
        const Eigen::Index last = strip_.positions.rows() - 1;
        return strip_.positions(last, 1) - motion_.cloth()(last, 1);
    }

private:
    static TriangleMesh drum()
    {
        constexpr int around = 96;
        TriangleMesh mesh;
        mesh.positions.resize(2 * around, 3);
        mesh.triangles.resize(2 * around, 3);
        for (int i = 0; i < around; ++i) {
            const double angle = 2 * std::numbers::pi * i / around;
            const int next = (i + 1) % around;
            for (const int side : { 0, 1 })
                mesh.positions.row(2 * i + side) << k_drum * std::cos(angle), k_drum * std::sin(angle), side - 0.5;
            mesh.triangles.row(2 * i) << 2 * i, 2 * next, 2 * i + 1;
            mesh.triangles.row(2 * i + 1) << 2 * i + 1, 2 * next, 2 * next + 1;
        }
        return mesh;
    }

    static Vec3 on_string(double along, double across)
    {
        const double r = k_drum + 2.45e-3, bend = along - k_short_end, turn = bend / r;
        if (turn < 0)
            return { -r, bend, across };
        if (turn < std::numbers::pi)
            return { -r * std::cos(turn), r * std::sin(turn), across };
        return { r, -(bend - std::numbers::pi * r), across };
    }

    static TriangleMesh strip(double long_end)
    {
        const double length = k_short_end + std::numbers::pi * (k_drum + 2.45e-3) + long_end;
        constexpr int wide = 4;
        const int rows = int(std::round(length / k_pitch)) + 1;
        TriangleMesh mesh;
        mesh.positions.resize(rows * wide, 3);
        mesh.triangles.resize(2 * (rows - 1) * (wide - 1), 3);
        for (int i = 0; i < rows; ++i)
            for (int k = 0; k < wide; ++k)
                mesh.positions.row(i * wide + k) = on_string(length * i / (rows - 1), k_pitch * (k - 1.5)).transpose();
        int f = 0;
        for (int i = 0; i + 1 < rows; ++i)
            for (int k = 0; k + 1 < wide; ++k) {
                const int v = i * wide + k;
                mesh.triangles.row(f++) << v, v + wide, v + 1;
                mesh.triangles.row(f++) << v + 1, v + wide, v + wide + 1;
            }
        return mesh;
    }

    TriangleMesh drum_, strip_;
    ClothMotion motion_;
};

// How long the longer end may be, m: T2 = T1 e^(mu pi) [euler_1769_ropes] for a string without weight. With the
// weight w per length on the drum, dT = mu (T + w r sin(a)) da + w r cos(a) da, which is integrated here.
double longest_end_that_holds()
{
    constexpr int steps = 10000;
    const double r = k_drum + 2.5e-3;
    double tension = k_short_end;  // over w
    for (int i = 0; i < steps; ++i) {
        const double angle = std::numbers::pi * (i + 0.5) / steps;
        // from the short end upwards: the weight pulls back at first, and forwards beyond the top
        tension += std::numbers::pi / steps * (k_friction * (tension + r * std::sin(angle)) + r * std::cos(angle));
    }
    return tension;
}

TEST(Friction, HoldsAStripOverADrumAsEulerAndEytelweinSay)
{
    const double limit = longest_end_that_holds();
    StripOverDrum holds(0.95 * limit), slips(1.05 * limit);
    for (StripOverDrum* strip : { &holds, &slips })
        strip->go_on(200);
    const double at_rest = holds.way_down(), begin = slips.way_down();
    for (StripOverDrum* strip : { &holds, &slips })
        strip->go_on(500);
    EXPECT_NEAR(holds.way_down(), at_rest, 1e-4);
    EXPECT_GT(slips.way_down(), begin + 3e-3);
}

}  // namespace
