// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "cloth_motion.h"
#include "fixtures.h"
#include "friction_anchors.h"
#include "garmentfit/certificate.h"
#include "limited_memory.h"
#include "stiff_details.h"
#include "tangent_factor.h"
#include "tuning.h"

// Static equilibrium: the tangent of the forces, quasi-Newton directions, friction on the way, and cloth that finds it.

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

TEST(TangentFactor, KnowsHowTheForcesOfSpringsFallAlongThem)
{
    const FreeCloth cloth(0.1);
    const Positions x = stretched(cloth.mesh);
    Positions way = Positions::Zero(x.rows(), 3);  // in the sheet, smooth: hinges have next to no part in it
    for (Eigen::Index v = 0; v < x.rows(); ++v)
        way(v, 0) = std::sin(8 * x(v, 2));
    constexpr double step = 1e-7;
    Positions forces = (cloth.energy.elastic_forces(x) - cloth.energy.elastic_forces(x + step * way)) / step;
    for (Eigen::Index v = 0; v < x.rows(); ++v)
        forces.row(v) += cloth.energy.masses()[v] * cloth.energy.inertia() * way.row(v);
    TangentFactor factor(cloth.energy);
    factor.factorise(x, {});
    EXPECT_LT((factor.solve(forces) - way).norm() / way.norm(), 0.05);
}

TEST(TangentFactor, KnowsThatWhatIsSewnMovesAlong)
{
    const TriangleMesh two = joined(sheet(0), flat(5, 0.02, Vec3(-0.05, 0.001, -0.05)));
    const int n = int(two.positions.rows());
    const GarmentMesh rest { two.positions, two.triangles };
    const MeshTopology topology(two.triangles, n);
    ClothEnergy energy(rest, topology, {}, ClothOptions(), find_sewn_pieces(rest, topology).ties);
    energy.set_time_step(0.1);
    TangentFactor factor(energy);
    factor.factorise(two.positions, {});
    Positions way = Positions::Zero(n, 3), forces = way;
    way.col(1).setConstant(1e-3);  // which only inertia is against
    for (int v = 0; v < n; ++v)
        forces.row(v) = energy.masses()[v] * energy.inertia() * way.row(v);
    EXPECT_LT((factor.solve(forces) - way).norm() / way.norm(), 0.05);
}

TEST(TangentFactor, HoldsWhatAConstraintHolds)
{
    const FreeCloth cloth(0.1);
    const Positions x = stretched(cloth.mesh);
    TangentFactor factor(cloth.energy);
    Positions pull = Positions::Zero(x.rows(), 3);
    pull(20, 1) = 1;
    const auto given_way = [&](const std::vector<SoftConstraint>& constraints) {
        factor.factorise(x, constraints);
        return factor.solve(pull)(20, 1);
    };
    const SoftConstraint held { { 20, 200, -1, -1 }, { 1, -1, 0, 0 }, Vec3::Zero(), Vec3::UnitY(), 1e4, 0 };
    EXPECT_LT(given_way({ held }), 0.05 * given_way({}));
    EXPECT_GT(given_way({ held }), 0);
}

TEST(FrictionAnchors, ResistWhatSlidesAcrossItsWay)
{
    FrictionAnchors anchors(1);
    anchors.set_active_contacts({ { 0, { -1, -1, -1 }, { 0, 0, 0 }, { 0, 2, 0 }, 0.5, 100 } },
                                Eigen::RowVector3d(0, 0, 0));
    const Vec3 here(0.5, 0, 0);
    const auto friction_at = [&](const Vec3& place) -> Vec3 {
        const SoftConstraint constraint = anchors.constraints(place.transpose(), 1).front();
        return constraint.stiffness_times(constraint.target - place);
    };
    const SoftConstraint there = anchors.constraints(here.transpose(), 1).front();
    constexpr double step = 1e-6;
    const Vec3 across = Vec3::UnitZ();
    const Vec3 drop = (friction_at(here) - friction_at(here + step * across)) / step;
    EXPECT_NEAR(there.stiffness_times(across).dot(across), drop.dot(across), 1e-4 * drop.norm());
    EXPECT_LT(there.stiffness_times(Vec3::UnitX()).x(), 0.1 * drop.norm()) << "none along its way, in truth";
}

TEST(LimitedMemory, LearnsWhatTheFirstGuessDoesNotKnow)
{
    const Eigen::RowVector3d stiffness(1, 30, 900);
    const auto forces_at = [&](const Positions& x) -> Positions { return -(x.array().rowwise() * stiffness.array()); };
    const auto solve = [](const Positions& forces) -> Positions { return forces / 900; };
    Positions x = Positions::Constant(5, 3, 1.0), forces = forces_at(x);
    LimitedMemory memory(8);
    for (int move = 0; move < 40; ++move) {
        const Positions way = memory.direction(forces, solve), before = forces;
        x += way;
        forces = forces_at(x);
        memory.remember(way, before - forces);
    }
    EXPECT_LT(x.norm(), 1e-6);
}

TEST(LimitedMemory, RemembersNoMoveAlongWhichForcesRise)
{
    LimitedMemory memory(8);
    const Positions way = Positions::Constant(2, 3, 1.0);
    memory.remember(way, -way);
    EXPECT_TRUE(memory.empty());
}

FrictionAnchors::ActiveContact pressed(double force)
{
    return { 0, { -1, -1, -1 }, { 0, 0, 0 }, { 0, force, 0 }, 0.5, 100 };
}

/// Along x, on a vertex at that x whose anchor is at 0.
double friction_at(const FrictionAnchors& anchors, double x, double share)
{
    const Positions here = Eigen::RowVector3d(x, 0, 0);
    Positions force = Positions::Zero(1, 3);
    for (const SoftConstraint& constraint : anchors.constraints(here, share))
        add_force(constraint, constraint.stiffness_times(constraint.target - constraint.sum(here)), force);
    return force(0, 0);
}

TEST(FrictionAnchors, HoldAsSpringsWithinTheConeAndPullEvenlyBeyond)
{
    FrictionAnchors anchors(1);
    anchors.set_active_contacts({ pressed(2) }, Eigen::RowVector3d(0, 0, 0));
    EXPECT_DOUBLE_EQ(friction_at(anchors, 0.005, 1), -0.5);
    EXPECT_DOUBLE_EQ(friction_at(anchors, 0.02, 1), -1);  // 0.5 of 2 N
    EXPECT_NEAR(friction_at(anchors, 3, 1), -1, 1e-12);
    EXPECT_NEAR(friction_at(anchors, 3, 0.8), -0.8, 1e-12);
}

TEST(FrictionAnchors, TakeTheMeanOfTheNormalForcesNowAndBefore)
{
    FrictionAnchors anchors(1);
    const Positions here = Eigen::RowVector3d(0, 0, 0);
    anchors.set_active_contacts({ pressed(2) }, here);
    anchors.set_active_contacts({ pressed(6) }, here);
    EXPECT_DOUBLE_EQ(friction_at(anchors, 3, 1), -2);  // 0.5 of 4 N
    for (int i = 0; i < 50; ++i)
        anchors.set_active_contacts({ pressed(6) }, here);
    EXPECT_NEAR(friction_at(anchors, 3, 1), -3, 1e-9);
}

TEST(FrictionAnchors, FollowWhatSlidAndThenHoldItWithLess)
{
    FrictionAnchors anchors(1);
    anchors.set_active_contacts({ pressed(2) }, Eigen::RowVector3d(0, 0, 0));
    anchors.follow(Eigen::RowVector3d(0.005, 0, 0), 1);
    EXPECT_DOUBLE_EQ(friction_at(anchors, 0.005, 1), -0.5) << "within the cone";
    const Positions far = Eigen::RowVector3d(3, 0, 0);
    anchors.follow(far, 1);
    anchors.set_active_contacts({ pressed(2) }, far);
    EXPECT_NEAR(friction_at(anchors, 3, 1), -k_kinetic_friction, 1e-12);
    EXPECT_NEAR(friction_at(anchors, 3 - 0.001, 1), 0.1 - k_kinetic_friction, 1e-12) << "a spring again";
}

TEST(FrictionAnchors, ForgetWhatNoLongerTouches)
{
    FrictionAnchors anchors(1);
    anchors.set_active_contacts({ pressed(2) }, Eigen::RowVector3d(0, 0, 0));
    anchors.set_active_contacts({}, Eigen::RowVector3d(1, 0, 0));
    EXPECT_DOUBLE_EQ(friction_at(anchors, 1, 1), 0);
    anchors.set_active_contacts({ pressed(2) }, Eigen::RowVector3d(1, 0, 0));
    EXPECT_LT(friction_at(anchors, 1, 1), 0) << "it only left for a moment";
    anchors.set_active_contacts({}, Eigen::RowVector3d(1, 0, 0));
    anchors.follow(Eigen::RowVector3d(1, 0, 0), 1);
    anchors.set_active_contacts({ pressed(2) }, Eigen::RowVector3d(1, 0, 0));
    EXPECT_DOUBLE_EQ(friction_at(anchors, 1, 1), 0);
}

/// A sheet over a ball that is wider than the ball.
ClothMotion sheet_over_ball(const TriangleMesh& obstacle)
{
    const TriangleMesh cloth = sheet(k_ball + 0.0035);
    ClothOptions options;
    options.friction = 0.4;
    return { GarmentMesh { cloth.positions, cloth.triangles }, cloth.positions, obstacle, options };
}

TEST(FindRest, BalancesTheForcesOnCloth)
{
    const TriangleMesh obstacle = ball();
    ClothMotion motion = sheet_over_ball(obstacle);
    settle(motion, obstacle.positions, 60, {});
    const auto [residual, out_of_time] = motion.find_rest(0, {});
    EXPECT_FALSE(out_of_time);
    EXPECT_TRUE(residual.is_at_rest()) << residual.mean << ' ' << residual.percentile_99;
    EXPECT_EQ(motion.obstacle(), obstacle.positions);
}

TEST(FindRest, IsWhereGoingOnMovesNothing)
{
    const TriangleMesh obstacle = ball();
    ClothMotion motion = sheet_over_ball(obstacle), same = sheet_over_ball(obstacle);
    for (ClothMotion* m : { &motion, &same })
        settle(*m, obstacle.positions, 60, {});
    motion.find_rest(0, {});
    same.find_rest(30, {});
    const Eigen::VectorXd moved = (motion.cloth() - same.cloth()).rowwise().norm();
    EXPECT_LT(moved.mean(), 1e-4);
    EXPECT_LT(moved.maxCoeff(), 5e-4);
}

/// m; how far a square sheet of these edges sinks into the contact distance over a table.
double depth_on_a_table(int vertices_a_side, double edge)
{
    const TriangleMesh table = flat(3, 0.3, Vec3(-0.3, 0, -0.3));
    const double half = 0.5 * (vertices_a_side - 1) * edge;
    const ClothOptions options;
    const TriangleMesh cloth = flat(vertices_a_side, edge, Vec3(-half, options.contact_distance, -half));
    ClothMotion motion(GarmentMesh { cloth.positions, cloth.triangles }, cloth.positions, table, options);
    EXPECT_TRUE(motion.find_rest(0, {}).residual.is_at_rest());
    return options.contact_distance - motion.cloth().col(1).mean();
}

TEST(FindRest, LetsClothSinkEquallyFarOnFineAndCoarseMeshes)
{
    const double coarse = depth_on_a_table(9, 0.02), fine = depth_on_a_table(33, 0.005);
    EXPECT_GT(coarse, 1e-6);
    EXPECT_NEAR(fine / coarse, 1, 0.15);  // a quarter, where each contact is as stiff
}

TEST(FindRest, LetsASheetWithoutFrictionSlideOff)
{
    const TriangleMesh obstacle = ball(), cloth = sheet(k_ball + 0.0035);
    ClothOptions slippery;
    slippery.friction = 0;
    Positions aside = cloth.positions;
    aside.col(0).array() += 0.1;
    ClothMotion motion(GarmentMesh { cloth.positions, cloth.triangles }, aside, obstacle, slippery);
    const double before = motion.cloth().col(1).mean();
    motion.find_rest(0, {});
    EXPECT_LT(motion.cloth().col(1).mean(), before - 0.05);
}

/// A button of 24 by 24 edges of 1 mm on two triangles of cloth, which lies half a millimetre under it.
struct ButtonOnCloth {
    TriangleMesh mesh = joined(flat(2, 0.04, Vec3::Zero()), flat(25, 0.001, Vec3(0.008, 5e-4, 0.008)));
    GarmentMesh rest { mesh.positions, mesh.triangles };
    SewnPieces sewn = find_sewn_pieces(rest, { mesh.triangles, int(mesh.positions.rows()) });
    StiffDetails details { sewn, mesh.positions };
};

TEST(StiffDetails, FollowTheirGround)
{
    const ButtonOnCloth cloth;
    EXPECT_FALSE(cloth.details.contains(0));
    ASSERT_TRUE(cloth.details.contains(4));
    const Eigen::Isometry3d motion
        = Eigen::Translation3d(0.1, 0.2, 0.3) * Eigen::AngleAxisd(2, Vec3(1, 2, -1).normalized());
    const Positions moved
        = (cloth.mesh.positions * motion.linear().transpose()).rowwise() + motion.translation().transpose();
    Positions x = cloth.mesh.positions;
    x.topRows(4) = moved.topRows(4);
    const Positions ways = cloth.details.following(x - cloth.mesh.positions, cloth.mesh.positions);
    EXPECT_LT((cloth.mesh.positions + ways - moved).cwiseAbs().maxCoeff(), 1e-12);
    cloth.details.follow(x);
    EXPECT_LT((x - moved).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(StiffDetails, ThatAreLinksHoldTheirGroundTogether)
{
    ButtonOnCloth cloth;
    cloth.sewn.details[0].linked = { std::vector { 0, 1 }, std::vector { 2, 3 } };
    const StiffDetails links(cloth.sewn, cloth.mesh.positions);
    Positions x = cloth.mesh.positions;
    x.row(0) += Eigen::RowVector3d(-0.01, 0.005, 0);
    Positions loose = x;
    cloth.details.follow(loose);
    links.follow(x);
    const auto distance = [](const Positions& of, int a, int b) { return (of.row(a) - of.row(b)).norm(); };
    for (const int v : { 1, 2, 3, 100 })
        EXPECT_NEAR(distance(x, 0, v), distance(cloth.mesh.positions, 0, v), 1e-12) << v;
    EXPECT_GT(distance(loose, 0, 1), distance(cloth.mesh.positions, 0, 1) + 0.005);
}

TEST(StiffDetails, HandDownForcesThatDoTheSameWork)
{
    const ButtonOnCloth cloth;
    const Positions x = cloth.mesh.positions;
    const Positions forces = Positions::NullaryExpr(
        x.rows(), 3, [](Eigen::Index v, Eigen::Index k) { return std::sin(double(3 * v + 7 * k)); });
    Positions on_ground = forces;
    cloth.details.hand_down(on_ground, x);
    EXPECT_EQ(on_ground.bottomRows(x.rows() - 4).norm(), 0);
    for (int v = 0; v < 4; ++v)
        for (int k = 0; k < 3; ++k) {
            Positions way = Positions::Zero(x.rows(), 3);
            way(v, k) = 1e-6;
            const double work = on_ground.cwiseProduct(way).sum();
            EXPECT_NEAR(forces.cwiseProduct(cloth.details.following(way, x)).sum() / work, 1, 1e-3) << v << ' ' << k;
        }
}

TEST(StiffDetails, HoldNothingInALine)
{
    SewnPieces sewn;
    sewn.details = { { { 3, 4, 5 } } };
    sewn.ties = { { 3, { 0, 1, 2 }, { 1, 0, 0 } } };
    Positions x = Positions::Zero(6, 3);
    x.col(0) = Eigen::VectorXd::LinSpaced(6, 0, 1);
    EXPECT_TRUE(StiffDetails(sewn, x).empty());
    x(2, 1) = 1;
    EXPECT_FALSE(StiffDetails(sewn, x).empty());
}

TEST(FindRest, BalancesTheForcesOnClothWithButtons)
{
    const TriangleMesh obstacle = ball();
    TriangleMesh cloth = sheet(k_ball + 0.0035);
    for (const double x : { -0.13, -0.05, 0.03, 0.11 })  // nearer to the cloth than contact lets them be
        cloth = joined(cloth, flat(8, 0.002, Vec3(x, k_ball + 0.0037, 0.05)));
    ClothMotion motion(GarmentMesh { cloth.positions, cloth.triangles }, cloth.positions, obstacle, {});
    settle(motion, obstacle.positions, 30, {});
    const auto [residual, out_of_time] = motion.find_rest(0, {});
    EXPECT_TRUE(residual.is_at_rest()) << residual.mean << ' ' << residual.percentile_99;
    EXPECT_TRUE(self_crossings({ motion.cloth(), cloth.triangles }).empty());
    EXPECT_EQ(crossing_count({ motion.cloth(), cloth.triangles }, obstacle), 0);
}

TEST(FindRest, EndsAtADeadline)
{
    const TriangleMesh obstacle = ball();
    ClothMotion motion = sheet_over_ball(obstacle);
    const auto [residual, out_of_time] = motion.find_rest(0, Progress().until(Deadline::in(1e-9)));
    EXPECT_TRUE(out_of_time);
    EXPECT_FALSE(residual.is_at_rest());
}

}  // namespace
