// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloth_motion.h"

#include <gtest/gtest.h>

#include <random>

#include "fixtures.h"
#include "garmentfit/certificate.h"
#include "garmentfit/fit_map.h"
#include "stall_detector.h"

namespace {

using namespace garmentfit;
using namespace garmentfit::fixtures;

/// Random numbers of one trial.
class Trial {
public:
    explicit Trial(int seed) : random_(unsigned(seed)) { }
    double between(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
    int up_to(int most) { return std::uniform_int_distribution(0, most)(random_); }

private:
    std::mt19937 random_;
};

/// A lumpy body about the y axis, some 0.1 m thick, its limbs as bumps.
TriangleMesh lumpy_body(Trial& trial)
{
    const double radius = trial.between(0.05, 0.1), swell = trial.between(0, 0.5);
    const int lobes = 2 + trial.up_to(4);
    const double turn = trial.between(0, 6), bend = trial.between(-0.04, 0.04);
    return polygonise(
        [=](const Vec3& p) {
            const double angle = std::atan2(p.z(), p.x());
            const double r = radius * (1 + swell * std::cos(lobes * angle + turn + 9 * p.y()));
            return std::hypot(p.x() - bend * std::sin(20 * p.y()), p.y() / 2, p.z()) - r;
        },
        Vec3::Constant(-0.3), Vec3::Constant(0.3), 0.045);
}

/// The body as thin as a line, where its growth begins.
Positions collapsed(const Positions& body)
{
    Positions thin = body;
    thin.col(0) *= 0.02;
    thin.col(2) *= 0.02;
    return thin;
}

/// A crumpled tube around the y axis, narrower or wider than the body.
TriangleMesh crumpled_tube(Trial& trial)
{
    const int round = 12 + trial.up_to(12), rows = 5 + trial.up_to(5);
    const double radius = trial.between(0.03, 0.13), length = trial.between(0.1, 0.35);
    const double crumple = trial.between(0, 0.25) * radius;
    TriangleMesh tube;
    tube.positions.resize(round * rows, 3);
    for (int v = 0; v < round * rows; ++v) {
        const double angle = 2 * M_PI * (v % round) / round, r = radius + trial.between(-crumple, crumple);
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

// Steps are far larger than in use: no step may cross, whatever its size.
TEST(ClothMotion, NeverCrossesWhateverBodyGrowsInWhateverCloth)
{
    for (int seed = 0; seed < 100; ++seed) {
        Trial trial(seed);
        const TriangleMesh body = lumpy_body(trial), tube = crumpled_tube(trial);
        const TriangleMesh thin { collapsed(body.positions), body.triangles };
        ASSERT_EQ(crossing_count(tube, thin), 0) << "seed " << seed;
        const std::vector<Crossing> given = self_crossings(tube);
        ClothMotion motion({ tube.positions, tube.triangles }, tube.positions, thin, {});
        MotionStep step;
        step.largest_move = trial.between(2e-3, 5e-2);
        step.largest_obstacle_move = trial.between(2e-3, 5e-2);
        step.gravity = trial.between(0, 30);
        step.friction_fraction = trial.between(0, 1);
        step.velocity_kept = trial.between(0, 0.95);
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

// At rest, pressure carries the part of the weight that is normal to the ball, friction the rest.
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
    const SettleResult settled = settle(motion, ball.positions, 150, {});
    EXPECT_LT(settled.speed, 0.02);
    const Positions x = motion.cloth();
    EXPECT_EQ(crossing_count({ x, cloth.triangles }, ball), 0);
    const double top = x.col(1).maxCoeff();
    EXPECT_GT(top, radius);
    EXPECT_LT(top, radius + options.contact_distance);

    const FitMap map = fit_map(ball, { rest, x, {} }, options);
    const double area = std::pow((n - 1) * spacing, 2) / double(3 * cloth.triangles.rows());  // m^2 at each corner
    double carried = 0, expected = 0;
    for (const int v : cloth.triangles.reshaped()) {
        const double upwards = x(v, 1) / x.row(v).norm();
        carried += area * map.pressure[v] * upwards;
        expected += area * material_of(options).density * 9.81 * upwards * upwards;
    }
    EXPECT_NEAR(carried / expected, 1, 0.1);
}

// Moves cloth for some steps while the obstacle grows by a tenth.
Positions grow_inside(ClothMotion& motion, const Positions& obstacle)
{
    const Positions target = 1.1 * obstacle;
    MotionStep step;
    step.obstacle_target = &target;
    for (int i = 0; i < 5; ++i)
        motion.advance(step);
    return motion.cloth();
}

TEST(ClothMotion, MovesAPreparedGarmentOverLayersAsTheGarmentOverTheirWhole)
{
    Trial trial(1);
    const TriangleMesh body = lumpy_body(trial), tube = crumpled_tube(trial);
    const GarmentMesh rest { tube.positions, tube.triangles };
    const TriangleMesh thin { collapsed(body.positions), body.triangles };
    PreparedCloth prepared = prepare_cloth(rest, rest.positions);
    untangle_clear_of(prepared, thin);
    ClothMotion from_prepared(prepared, { thin, int(thin.positions.rows()) / 2 }, {});
    ClothMotion from_garment(rest, rest.positions, thin, {});
    EXPECT_EQ(grow_inside(from_prepared, thin.positions), grow_inside(from_garment, thin.positions));
}

TEST(StallDetector, WaitsAsLongAsTheLagFallsAndNoLongerThanAsked)
{
    const auto steps = [](double factor, int most) {
        StallDetector detector(most);
        double lag = 1;
        int count = 0;
        for (; detector.goes_on(lag); ++count)
            lag *= factor;
        return count;
    };
    EXPECT_EQ(steps(0.9, 40), 40);
    EXPECT_LT(steps(1, 40), 40);
    EXPECT_EQ(steps(0, 40), 1);
}

}  // namespace
