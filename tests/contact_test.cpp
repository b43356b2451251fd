// SPDX-License-Identifier: GPL-3.0-or-later
// The private steps under drape_garment.h and recover_pose.h: what they stand on is tested here.
#include "../libfit/src/contact.h"

#include <gtest/gtest.h>

#include <random>

#include "../libfit/src/cloth_energy.h"
#include "../libfit/src/cloth_motion.h"
#include "../libfit/src/collapse.h"
#include "fixtures.h"

namespace {

using namespace fit;
using namespace fit::fixtures;

// A tube round +y with open ends.
GarmentMesh tube(double radius, int rings = 12, int around = 24)
{
    GarmentMesh mesh { Positions(rings * around, 3), Triangles(2 * (rings - 1) * around, 3) };
    for (int r = 0; r < rings; ++r)
        for (int a = 0; a < around; ++a) {
            const double angle = 2 * M_PI * a / around;
            mesh.positions.row(r * around + a) << radius * std::sin(angle), 0.03 * (r - rings / 2.0),
                radius * std::cos(angle);
        }
    int f = 0;
    for (int r = 0; r + 1 < rings; ++r)
        for (int a = 0; a < around; ++a) {
            const int i = r * around + a, j = r * around + (a + 1) % around;
            mesh.triangles.row(f++) << i, j, i + around;
            mesh.triangles.row(f++) << j, j + around, i + around;
        }
    return mesh;
}

TriangleMesh ball(double radius)
{
    return polygonise([&](const Vec3& p) { return p.norm() - radius; }, Vec3::Constant(-radius - 0.1),
                      Vec3::Constant(radius + 0.1), 0.25 * radius);
}

Corners random_corners(std::mt19937& random)
{
    std::uniform_real_distribution<double> uniform(-1, 1);
    Corners x;
    for (Vec3& p : x)
        p = Vec3(uniform(random), uniform(random), uniform(random));
    return x;
}

TEST(Proximity, ClosestPointsAreNoFurtherThanAnySample)
{
    std::mt19937 random(1);
    for (int trial = 0; trial < 200; ++trial) {
        const Corners x = random_corners(random);
        const double face = closest(PairKind::vertex_face, x).distance,
                     edges = closest(PairKind::edge_edge, x).distance;
        for (double s = 0; s <= 1; s += 0.1)
            for (double t = 0; t <= 1; t += 0.1) {
                EXPECT_LE(edges, (x[0] + s * (x[1] - x[0]) - x[2] - t * (x[3] - x[2])).norm() + 1e-12);
                if (s + t <= 1) {
                    EXPECT_LE(face, (x[0] - x[1] - s * (x[2] - x[1]) - t * (x[3] - x[1])).norm() + 1e-12);
                }
            }
    }
}

TEST(Proximity, DegeneratePrimitivesHaveDistances)
{
    const Vec3 o = Vec3::Zero(), x = Vec3::UnitX(), y = Vec3::UnitY();
    EXPECT_DOUBLE_EQ(closest(PairKind::vertex_face, { y, o, o, o }).distance, 1);
    EXPECT_DOUBLE_EQ(closest(PairKind::vertex_face, { y, -x, o, x }).distance, 1);
    EXPECT_DOUBLE_EQ(closest(PairKind::edge_edge, { y, y, o, o }).distance, 1);
    EXPECT_DOUBLE_EQ(closest(PairKind::edge_edge, { y, Vec3(x + y), o, x }).distance, 1);  // parallel
}

TEST(Proximity, TheFreeShareNeverComesNearerThanItMay)
{
    std::mt19937 random(2);
    constexpr double gap = 0.01;
    for (int trial = 0; trial < 500; ++trial)
        for (const PairKind kind : { PairKind::vertex_face, PairKind::edge_edge }) {
            const Corners x = random_corners(random), d = random_corners(random);
            const double share = free_share(kind, x, d, gap), allowed = kept_distance(closest(kind, x).distance, gap);
            for (double t = 0; t <= 1; t += 0.05) {
                Corners moved = x;
                for (int k = 0; k < 4; ++k)
                    moved[k] += t * share * d[k];
                EXPECT_GE(closest(kind, moved).distance, allowed - 1e-12);
            }
        }
}

TEST(Proximity, CommonMotionIsFree)
{
    Corners x { Vec3(0, 1e-7, 0), Vec3(-1, 0, -1), Vec3(1, 0, -1), Vec3(0, 0, 1) };
    EXPECT_EQ(
        free_share(PairKind::vertex_face, x, { Vec3(3, -2, 1), Vec3(3, -2, 1), Vec3(3, -2, 1), Vec3(3, -2, 1) }, 1e-4),
        1);
    EXPECT_EQ(free_share(PairKind::vertex_face, x, { Vec3(0, 1, 0), Vec3::Zero(), Vec3::Zero(), Vec3::Zero() }, 1e-4),
              1);
}

TEST(Contact, NoVertexPassesThroughAnythingHoweverItIsPushed)
{
    const GarmentMesh cloth = tube(0.15);
    const TriangleMesh obstacle = ball(0.1);
    const int n = int(cloth.positions.rows()), m = int(obstacle.positions.rows());
    Contact contact(cloth.triangles, n, obstacle.triangles);
    Positions x(n + m, 3);
    x << cloth.positions, obstacle.positions;
    std::srand(3);
    for (int step = 0; step < 30; ++step) {
        Positions push = 0.02 * Positions::Random(n + m, 3);
        push.topRows(n) -= 0.1 * x.topRows(n);  // the cloth is crushed onto the ball and itself
        const Eigen::VectorXd lengths = push.rowwise().norm();
        contact.detect(x, { lengths.data(), lengths.data() + lengths.size() });
        const std::vector<double> shares = contact.free_shares(x, push, 1e-4);
        for (int v = 0; v < n + m; ++v)
            x.row(v) += shares[v] * push.row(v);
        const TriangleMesh now { x.topRows(n), cloth.triangles };
        ASSERT_EQ(crossing_count(now, { x.bottomRows(m), obstacle.triangles }), 0) << "step " << step;
        ASSERT_TRUE(self_crossings(now).empty()) << "step " << step;
    }
}

TEST(ClothEnergy, AGarmentAtRestStays)
{
    const GarmentMesh cloth = tube(0.15);
    ClothEnergy energy(cloth, {}, {});
    energy.prepare(0.02, std::vector<double>(cloth.positions.rows(), 0.0));
    const Positions x = energy.minimized(cloth.positions, cloth.positions, {});
    EXPECT_LT((x - cloth.positions).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(ClothEnergy, FallsFreelyByHalfGTimesTimeSquared)
{
    const GarmentMesh cloth = tube(0.15);
    const TriangleMesh far
        = { (ball(0.1).positions.rowwise() + Eigen::RowVector3d(9, 0, 0)).eval(), ball(0.1).triangles };
    ClothMotion motion(cloth, cloth.positions, far, {});
    const Positions target = far.positions;
    MotionStep step;
    step.obstacle_target = &target;
    step.gravity = k_gravity;
    step.velocity_kept = 1;
    step.time_step = 0.002;
    step.largest_move = 0.01;
    const int steps = 50;
    for (int i = 0; i < steps; ++i)
        motion.advance(step);
    const double time = steps * step.time_step, fallen = cloth.positions.col(1).mean() - motion.cloth().col(1).mean();
    EXPECT_NEAR(fallen, 0.5 * k_gravity * time * time, 0.03 * fallen);  // implicit Euler is g h t / 2 ahead
    EXPECT_NEAR(motion.cloth().col(0).mean(), cloth.positions.col(0).mean(), 1e-9);
}

TEST(ClothEnergy, AStretchedGarmentGetsBackTowardsItsLengths)
{
    const GarmentMesh cloth = tube(0.15);
    ClothEnergy energy(cloth, {}, {});
    energy.prepare(0.02, std::vector<double>(cloth.positions.rows(), 0.0));
    Positions x = 1.2 * cloth.positions;
    double strain = strain_of(cloth, x).median;
    for (int i = 0; i < 10; ++i) {
        x = energy.minimized(x, x, {});
        EXPECT_LT(strain_of(cloth, x).median, strain);
        strain = strain_of(cloth, x).median;
    }
    EXPECT_LT(strain, 0.02);
}

TEST(ClothMotion, KeepsAGapAfterEveryStepWhileABallGrowsInsideATube)
{
    const GarmentMesh cloth = tube(0.15);
    const TriangleMesh small = ball(0.05), unit = ball(1);
    ClothMotion motion(cloth, cloth.positions, { 0.05 * unit.positions, unit.triangles }, {});
    MotionStep step;
    step.largest_move = step.largest_obstacle_move = 0.01;
    for (double radius = 0.05; radius < 0.165; radius += 0.005) {
        const Positions target = radius * unit.positions;
        step.obstacle_target = &target;
        motion.advance(step);
        const Certificate certificate = certify({ motion.obstacle(), unit.triangles }, cloth, motion.cloth());
        ASSERT_TRUE(certificate.clean()) << "radius " << radius;
        ASSERT_GT(certificate.smallest_gap, 0);
    }
    EXPECT_GT(strain_of(cloth, motion.cloth()).max, 0.05);  // the tube was narrower than the ball
}

TEST(ClothMotion, MovesTheSameForAnyOrderOfThreads)
{
    const GarmentMesh cloth = tube(0.12);
    const TriangleMesh unit = ball(1);
    const Positions target = 0.13 * unit.positions;
    const auto run = [&] {
        ClothMotion motion(cloth, cloth.positions, { 0.1 * unit.positions, unit.triangles }, {});
        MotionStep step;
        step.obstacle_target = &target;
        step.largest_move = step.largest_obstacle_move = 0.01;
        for (int i = 0; i < 8; ++i)
            motion.advance(step);
        return motion.cloth();
    };
    EXPECT_EQ(run(), run());
}

TEST(Collapse, EveryVertexEndsOnTheSkeleton)
{
    const Person person = capsule_person();
    const Skeleton& s = person.skeleton;
    SkinWeights weights;
    weights.bones = Eigen::MatrixXi::Zero(2, 4);
    weights.weights = Eigen::MatrixXd::Zero(2, 4);
    weights.bones.row(0) << thorax, lhumerus, 0, 0;
    weights.weights.row(0) << 0.5, 0.5, 0, 0;
    weights.bones.row(1) << lfemur, rfemur, 0, 0;
    weights.weights.row(1) << 0.5, 0.5, 0, 0;
    Positions points(2, 3);
    points << 0.14, 1.3, 0, 0, 0.85, 0;
    const Positions core = collapse(points, weights, s);
    // the armpit goes to the way from spine to arm over the shoulder, the crotch to the root between the hips
    EXPECT_GT(core(0, 1), 1.38);
    EXPECT_LT((core.row(1).transpose() - s.root).norm(), 0.02);
}

}  // namespace
