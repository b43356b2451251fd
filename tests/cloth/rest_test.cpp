// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "cloth_motion.h"
#include "fixtures.h"
#include "newton_step.h"
#include "tangent_system.h"

// Static equilibrium: the tangent of the forces, Newton's method, and cloth that goes on to rest.

namespace {

using namespace garmentfit;
using namespace garmentfit::fixtures;

constexpr double k_ball = 0.1;  // m, radius

TriangleMesh sheet(double height) { return flat(17, 0.02, Vec3(-0.16, height, -0.16)); }

TriangleMesh ball()
{
    return polygonise([](const Vec3& p) { return p.norm() - k_ball; }, Vec3::Constant(-0.12), Vec3::Constant(0.12),
                      0.01);
}

/// Stretched by a tenth along x and bent a little, so that no spring is compressed.
Positions stretched(const TriangleMesh& mesh)
{
    Positions x = mesh.positions;
    x.col(0) *= 1.1;
    x.col(2) *= 1.05;
    for (Eigen::Index v = 0; v < x.rows(); ++v)
        x(v, 1) += 0.01 * std::sin(10 * x(v, 0));
    return x;
}

struct FreeCloth {
    TriangleMesh mesh = sheet(0);
    MeshTopology topology { mesh.triangles, int(mesh.positions.rows()) };
    ClothEnergy energy { GarmentMesh { mesh.positions, mesh.triangles }, topology, {}, ClothOptions() };

    explicit FreeCloth(double time_step) { energy.set_time_step(time_step); }
};

TEST(TangentSystem, IsHowTheForcesOfSpringsFallAlongThem)
{
    const FreeCloth cloth(0.1);
    const Positions x = stretched(cloth.mesh);
    const TangentSystem tangent(cloth.energy, x, {});
    Positions way = Positions::Zero(x.rows(), 3);  // in the sheet, smooth: hinges have next to no part in it
    for (Eigen::Index v = 0; v < x.rows(); ++v)
        way(v, 0) = std::sin(8 * x(v, 2));
    constexpr double step = 1e-7;
    const Positions difference = (cloth.energy.elastic_forces(x) - cloth.energy.elastic_forces(x + step * way)) / step;
    Positions expected = difference;
    for (Eigen::Index v = 0; v < x.rows(); ++v)
        expected.row(v) += cloth.energy.masses()[v] * cloth.energy.inertia() * way.row(v);
    EXPECT_LT((tangent.multiply(way) - expected).norm() / expected.norm(), 1e-3);
}

TEST(TangentSystem, FindsTheDisplacementOfGivenForces)
{
    const FreeCloth cloth(0.1);
    const Positions x = stretched(cloth.mesh);
    const std::vector<SoftConstraint> held {
        { { 0, 1, 18, -1 }, { 0.2, 0.3, 0.5, 0 }, Vec3::Zero(), Vec3::UnitY(), 400, 100 }
    };
    const TangentSystem tangent(cloth.energy, x, held);
    Positions way(x.rows(), 3);
    for (Eigen::Index v = 0; v < x.rows(); ++v)
        way.row(v) << 0.001 * std::cos(9 * x(v, 2)), 0.01 * x(v, 0), 0.002;
    const Positions found = tangent.solve(tangent.multiply(way), 1e-10);
    EXPECT_LT((found - way).norm() / way.norm(), 1e-6);
}

/// A sheet over a ball that is wider than the ball.
ClothMotion sheet_over_ball(const TriangleMesh& obstacle)
{
    const TriangleMesh cloth = sheet(k_ball + 0.0035);
    ClothOptions options;
    options.friction = 0.4;
    return { GarmentMesh { cloth.positions, cloth.triangles }, cloth.positions, obstacle, options };
}

TEST(GoOnToRest, BringsForcesNearerToBalanceThanSettlingDoes)
{
    const TriangleMesh obstacle = ball();
    ClothMotion motion = sheet_over_ball(obstacle);
    settle(motion, obstacle.positions, 60, 0, {});
    const std::optional<ForceResidual> settled = go_on_to_rest(motion, 0, {}), rest = go_on_to_rest(motion, 10, {});
    ASSERT_TRUE(settled && rest);
    EXPECT_LT(rest->mean, 0.2 * settled->mean);
    EXPECT_EQ(motion.obstacle(), obstacle.positions);
}

TEST(GoOnToRest, LeavesASheetThatFrictionHolds)
{
    const TriangleMesh obstacle = ball();
    ClothMotion motion = sheet_over_ball(obstacle);
    settle(motion, obstacle.positions, 60, 0, {});
    go_on_to_rest(motion, 20, {});
    const Positions rest = motion.cloth();
    go_on_to_rest(motion, 10, {});
    const Eigen::VectorXd moved = (motion.cloth() - rest).rowwise().norm();
    EXPECT_LT(moved.mean(), 1e-3);
    EXPECT_LT(moved.maxCoeff(), 5e-3);
}

}  // namespace
