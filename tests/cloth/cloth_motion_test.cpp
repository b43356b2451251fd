// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloth_motion.h"

#include <gtest/gtest.h>

#include <random>

#include "fixtures.h"
#include "garmentfit/certificate.h"
#include "garmentfit/fit_map.h"

namespace {

using namespace garmentfit;
using namespace garmentfit::fixtures;

/// What a hundred bodies and garments differ in.
class Whim {
public:
    explicit Whim(int seed) : random_(unsigned(seed)) { }
    double between(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
    int up_to(int most) { return std::uniform_int_distribution(0, most)(random_); }

private:
    std::mt19937 random_;
};

/// A lumpy body about the y axis, some 0.1 m thick, its limbs as bumps.
TriangleMesh lumpy_body(Whim& whim)
{
    const double radius = whim.between(0.05, 0.1), swell = whim.between(0, 0.5);
    const int lobes = 2 + whim.up_to(4);
    const double turn = whim.between(0, 6), bend = whim.between(-0.04, 0.04);
    return polygonise(
        [=](const Vec3& p) {
            const double angle = std::atan2(p.z(), p.x());
            const double r = radius * (1 + swell * std::cos(lobes * angle + turn + 9 * p.y()));
            return std::hypot(p.x() - bend * std::sin(20 * p.y()), p.y() / 2, p.z()) - r;
        },
        Vec3::Constant(-0.3), Vec3::Constant(0.3), 0.045);
}

/// The body as thin as a line, where inflating begins.
Positions collapsed(const Positions& body)
{
    Positions thin = body;
    thin.col(0) *= 0.02;
    thin.col(2) *= 0.02;
    return thin;
}

/// A tube round the y axis, crumpled: narrower than the body or wider.
TriangleMesh crumpled_tube(Whim& whim)
{
    const int round = 12 + whim.up_to(12), rows = 5 + whim.up_to(5);
    const double radius = whim.between(0.03, 0.13), length = whim.between(0.1, 0.35);
    const double crumple = whim.between(0, 0.25) * radius;
    TriangleMesh tube;
    tube.positions.resize(round * rows, 3);
    for (int v = 0; v < round * rows; ++v) {
        const double angle = 2 * M_PI * (v % round) / round, r = radius + whim.between(-crumple, crumple);
        tube.positions.row(v) << r * std::cos(angle), length * (double(v / round) / (rows - 1) - 0.5),
            r * std::sin(angle);
    }
    tube.triangles.resize(2 * round * (rows - 1), 3);
    for (int f = 0, v = 0; v < round * (rows - 1); ++v) {
        const int next = v % round + 1 < round ? v + 1 : v + 1 - round;
        tube.triangles.row(f++) << v, v + round, next;
        tube.triangles.row(f++) << next, v + round, next + round;
    }
    return tube;
}

// Steps far too large for comfort: what is promised holds for any.
TEST(ClothMotion, NeverCrossesWhateverIsInflatedInWhateverCloth)
{
    for (int seed = 0; seed < 100; ++seed) {
        Whim whim(seed);
        const TriangleMesh body = lumpy_body(whim), tube = crumpled_tube(whim);
        const TriangleMesh thin { collapsed(body.positions), body.triangles };
        ASSERT_EQ(crossing_count(tube, thin), 0) << "seed " << seed;
        const std::vector<Crossing> given = self_crossings(tube);
        ClothMotion motion({ tube.positions, tube.triangles }, tube.positions, thin, {});
        MotionStep step;
        step.largest_move = whim.between(2e-3, 5e-2);
        step.largest_obstacle_move = whim.between(2e-3, 5e-2);
        step.gravity = whim.between(0, 30);
        step.friction_fraction = whim.between(0, 1);
        step.velocity_kept = whim.between(0, 0.95);
        constexpr int steps = 8;
        for (int i = 1; i <= steps; ++i) {
            const Positions target = thin.positions + double(i) / steps * (body.positions - thin.positions);
            step.obstacle_target = &target;
            motion.advance(step);
            ASSERT_TRUE(motion.cloth().allFinite() && motion.obstacle().allFinite()) << "seed " << seed;
            ASSERT_EQ(crossing_count({ motion.cloth(), tube.triangles }, { motion.obstacle(), body.triangles }), 0)
                << "seed " << seed << ", step " << i;
            for (const Crossing& pair : self_crossings({ motion.cloth(), tube.triangles }))
                ASSERT_EQ(std::count(given.begin(), given.end(), pair), 1) << "seed " << seed << ", step " << i;
        }
    }
}

// At rest, pressure carries the part of the weight that is square to the ball, friction the rest.
TEST(ClothMotion, AClothLaidOnABallRestsOnItWithItsWeight)
{
    constexpr double radius = 0.15, spacing = 0.01;
    constexpr int n = 13;
    TriangleMesh ball
        = polygonise([](const Vec3& p) { return p.norm() - radius; }, Vec3::Constant(-0.2), Vec3::Constant(0.2), 0.015);
    TriangleMesh cloth = sheet(n, spacing, [](double, double) { return radius + 4e-3; });
    cloth.positions.col(0).array() -= 0.5 * (n - 1) * spacing;
    cloth.positions.col(2).array() -= 0.5 * (n - 1) * spacing;
    const GarmentMesh rest { cloth.positions, cloth.triangles };
    ClothOptions options;
    ClothMotion motion(rest, rest.positions, ball, options);
    const SettleResult settled = settle(motion, ball.positions, 150, 0, {});
    EXPECT_LT(settled.speed, 0.02);
    const Positions x = motion.cloth();
    EXPECT_EQ(crossing_count({ x, cloth.triangles }, ball), 0);
    const double top = x.col(1).maxCoeff();
    EXPECT_GT(top, radius);
    EXPECT_LT(top, radius + options.contact_distance);

    const FitMap map = fit_map(ball, { rest, x, {} }, options);
    const double share = std::pow((n - 1) * spacing, 2) / double(3 * cloth.triangles.rows());  // m^2 at each corner
    double carried = 0, expected = 0;
    for (const int v : cloth.triangles.reshaped()) {
        const double upwards = x(v, 1) / x.row(v).norm();
        carried += share * map.pressure[v] * upwards;
        expected += share * material_of(options).density * 9.81 * upwards * upwards;
    }
    EXPECT_NEAR(carried / expected, 1, 0.1);
}

}  // namespace
