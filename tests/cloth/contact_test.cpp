// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact.h"

#include <gtest/gtest.h>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <random>
#include <set>

#include "cloth_motion.h"
#include "collapse.h"
#include "collision_free_step.h"
#include "fixtures.h"
#include "garmentfit/certificate.h"
#include "preconditioned_cg.h"

namespace {

using namespace garmentfit;
using namespace garmentfit::fixtures;

// A tube around +y with open ends.
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

MeshTopology topology_of(const GarmentMesh& mesh) { return { mesh.triangles, int(mesh.positions.rows()) }; }

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
        const double face = closest_points(PairKind::vertex_face, x).distance,
                     edges = closest_points(PairKind::edge_edge, x).distance;
        for (double s = 0; s <= 1; s += 0.1)
            for (double t = 0; t <= 1; t += 0.1) {
                EXPECT_LE(edges, (x[0] + s * (x[1] - x[0]) - x[2] - t * (x[3] - x[2])).norm() + 1e-12);
                if (s + t <= 1) {
                    EXPECT_LE(face, (x[0] - x[1] - s * (x[2] - x[1]) - t * (x[3] - x[1])).norm() + 1e-12);
                }
            }
    }
}

TEST(Proximity, SurelyApartIsNeverSaidOfWhatIsNearer)
{
    std::mt19937 random(2);
    int said = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        const Corners x = random_corners(random);
        for (const PairKind kind : { PairKind::vertex_face, PairKind::edge_edge }) {
            const double distance = closest_points(kind, x).distance;
            EXPECT_FALSE(are_surely_apart(kind, x, 1.0000001 * distance));
            said += are_surely_apart(kind, x, 0.5 * distance);
        }
    }
    EXPECT_GT(said, 2000);  // of 4,000
}

TEST(Proximity, DegeneratePrimitivesHaveDistances)
{
    const Vec3 o = Vec3::Zero(), x = Vec3::UnitX(), y = Vec3::UnitY();
    EXPECT_DOUBLE_EQ(closest_points(PairKind::vertex_face, { y, o, o, o }).distance, 1);
    EXPECT_DOUBLE_EQ(closest_points(PairKind::vertex_face, { y, -x, o, x }).distance, 1);
    EXPECT_DOUBLE_EQ(closest_points(PairKind::edge_edge, { y, y, o, o }).distance, 1);
    EXPECT_DOUBLE_EQ(closest_points(PairKind::edge_edge, { y, Vec3(x + y), o, x }).distance, 1);  // parallel
}

TEST(Proximity, ACollisionFreeFractionKeepsTheRequiredDistance)
{
    std::mt19937 random(2);
    constexpr double gap = 0.01;
    for (int trial = 0; trial < 500; ++trial)
        for (const PairKind kind : { PairKind::vertex_face, PairKind::edge_edge }) {
            const Corners x = random_corners(random), d = random_corners(random);
            const double fraction = collision_free_fraction(kind, x, d, gap),
                         allowed = required_distance(closest_points(kind, x).distance, gap);
            for (double t = 0; t <= 1; t += 0.05) {
                Corners moved = x;
                for (int k = 0; k < 4; ++k)
                    moved[k] += t * fraction * d[k];
                EXPECT_GE(closest_points(kind, moved).distance, allowed - 1e-12);
            }
        }
}

TEST(Proximity, AMotionStraightAtATriangleUsesMostOfTheGap)
{
    const Corners x { Vec3(0.002, 0.001, 0.002), Vec3(0, 0, 0), Vec3(0.01, 0, 0), Vec3(0, 0, 0.01) },
        down { Vec3(0, -0.01, 0), Vec3::Zero(), Vec3::Zero(), Vec3::Zero() };
    const double usable = 0.001 - required_distance(0.001, 1e-4),
                 used = 0.01 * collision_free_fraction(PairKind::vertex_face, x, down, 1e-4);
    EXPECT_GT(used, 0.8 * usable);
    EXPECT_LE(used, usable);
}

// 10 nm above the minimum distance, by the longest way alone, each advance would be about 10 nm.
TEST(Proximity, WhatPartsWhileItSlidesIsFree)
{
    const double gap = 1e-4 + 1e-8;
    const Corners vertex { Vec3(0.002, gap, 0.002), Vec3(0, 0, 0), Vec3(0.01, 0, 0), Vec3(0, 0, 0.01) },
        edges { Vec3(-1, gap, 0), Vec3(1, gap, 0), Vec3(0, 0, -1), Vec3(0, 0, 1) };
    const Vec3 aside(0.005, 1e-5, 0);
    EXPECT_EQ(collision_free_fraction(PairKind::vertex_face, vertex,
                                      { aside, Vec3::Zero(), Vec3::Zero(), Vec3::Zero() }, 1e-4),
              1);
    EXPECT_EQ(
        collision_free_fraction(PairKind::edge_edge, edges, { aside, 2 * aside, Vec3::Zero(), Vec3::Zero() }, 1e-4), 1);
}

TEST(Proximity, CommonMotionIsFree)
{
    Corners x { Vec3(0, 1e-7, 0), Vec3(-1, 0, -1), Vec3(1, 0, -1), Vec3(0, 0, 1) };
    EXPECT_EQ(collision_free_fraction(PairKind::vertex_face, x,
                                      { Vec3(3, -2, 1), Vec3(3, -2, 1), Vec3(3, -2, 1), Vec3(3, -2, 1) }, 1e-4),
              1);
    EXPECT_EQ(collision_free_fraction(PairKind::vertex_face, x,
                                      { Vec3(0, 1, 0), Vec3::Zero(), Vec3::Zero(), Vec3::Zero() }, 1e-4),
              1);
}

ContactDetector detector_of(const Triangles& cloth, int cloth_vertices, const Triangles& obstacle, int body_vertices,
                            const Margins& spare = { 0, 0 })
{
    return { { cloth, edges_of(cloth), cloth_vertices },
             { obstacle, edges_of(obstacle), body_vertices },
             body_vertices,
             spare };
}

TEST(Contact, NothingCrossesHoweverItIsPushed)
{
    const GarmentMesh cloth = tube(0.15);
    const TriangleMesh obstacle = ball(0.1);
    const int n = int(cloth.positions.rows()), m = int(obstacle.positions.rows());
    ContactDetector contact = detector_of(cloth.triangles, n, obstacle.triangles, m);
    Positions x(n + m, 3);
    x << cloth.positions, obstacle.positions;
    std::srand(3);
    for (int step = 0; step < 30; ++step) {
        Positions push = 0.02 * Positions::Random(n + m, 3);
        push.topRows(n) -= 0.1 * x.topRows(n);  // the cloth is crushed onto the ball and itself
        contact.detect(x, push, { 1e-4, 1e-4 });
        const std::vector<double> fractions = collision_free_fractions(contact.pairs(), x, push, 1e-4);
        for (int v = 0; v < n + m; ++v)
            x.row(v) += fractions[v] * push.row(v);
        const TriangleMesh now { x.topRows(n), cloth.triangles };
        ASSERT_EQ(crossing_count(now, { x.bottomRows(m), obstacle.triangles }), 0) << "step " << step;
        ASSERT_TRUE(self_crossings(now).empty()) << "step " << step;
    }
}

TEST(Contact, ASearchServesLaterDetectionsAsAFreshOneWould)
{
    const GarmentMesh cloth = tube(0.11);
    const TriangleMesh obstacle = ball(0.1);
    const int n = int(cloth.positions.rows()), m = int(obstacle.positions.rows());
    ContactDetector lasting = detector_of(cloth.triangles, n, obstacle.triangles, m, { 5e-3, 8e-3 });
    Positions x(n + m, 3);
    x << cloth.positions, obstacle.positions;
    const auto meeting = [](const ContactDetector& contact) {
        std::set<std::pair<PairKind, std::array<int, 4>>> result;
        for (const ContactPair& pair : contact.pairs())
            result.emplace(pair.kind, pair.vertices);
        return result;
    };
    std::srand(4);
    for (int step = 0; step < 30; ++step) {
        ContactDetector fresh = detector_of(cloth.triangles, n, obstacle.triangles, m);
        fresh.detect(x, Positions::Zero(n + m, 3), { 3e-3, 7e-3 });
        lasting.detect(x, Positions::Zero(n + m, 3), { 3e-3, 7e-3 });
        EXPECT_FALSE(fresh.pairs().empty());
        EXPECT_EQ(meeting(lasting), meeting(fresh)) << "step " << step;
        if (step % 3 == 0)  // far enough for a new search, while the obstacle stands still
            x.topRows(n) += 6e-3 * Positions::Random(n, 3);
        else if (step % 3 == 1)  // some, so that their pairs alone are searched anew
            x.middleRows(n - 20, 30) += 6e-3 * Positions::Random(30, 3);
        else
            x += 5e-4 * Positions::Random(n + m, 3);
    }
}

TEST(Contact, PairsThatCollideMoveAsOneZoneAndTheOthersOnTheirOwn)
{
    // two sheets that nearly touch, pushed into each other and along +z, and a third one far away
    const auto sheet = [](double y) {
        Positions p(3, 3);
        p << 0, y, 0, 1, y, 0, 0, y, 1;
        return p;
    };
    Positions x(9, 3), push(9, 3);
    x << sheet(0), sheet(1e-5), sheet(1);
    push << Positions::Constant(3, 3, 0.02), Positions::Constant(3, 3, -0.02), Positions::Constant(3, 3, 0.01);
    push.col(2).array() += 0.1;
    Triangles triangles(3, 3);
    triangles << 0, 1, 2, 3, 4, 5, 6, 7, 8;
    constexpr int cloth_vertices = 9;
    ContactDetector contact = detector_of(triangles, cloth_vertices, Triangles(0, 3), 0);
    contact.detect(x, push, { 1e-4, 1e-4 });
    const Positions together = merge_impact_zones(contact.pairs(), cloth_vertices, x, push, 1e-4);
    for (int v = 0; v < 6; ++v)
        EXPECT_LT((together.row(v) - Eigen::RowVector3d(0, 0, 0.1)).norm(), 1e-12) << v;
    EXPECT_EQ(together.bottomRows(3), push.bottomRows(3));
    EXPECT_EQ(collision_free_fractions(contact.pairs(), x, together, 1e-4), std::vector<double>(9, 1.0));
}

TEST(Contact, AZoneWithAnObstacleThatStandsStillStandsStill)
{
    Positions x(6, 3), push = Positions::Zero(6, 3);
    x << 0, 1e-5, 0, 1, 1e-5, 0, 0, 1e-5, 1, 0, 0, 0, 1, 0, 0, 0, 0, 1;
    push.topRows(3).col(1).setConstant(-0.02);
    push.topRows(3).col(2).setConstant(0.1);
    Triangles triangle(1, 3);
    triangle << 0, 1, 2;
    constexpr int cloth_vertices = 3;
    ContactDetector contact = detector_of(triangle, cloth_vertices, triangle, 3);
    contact.detect(x, push, { 1e-4, 1e-4 });
    EXPECT_TRUE(merge_impact_zones(contact.pairs(), cloth_vertices, x, push, 1e-4).isZero(0));
    push.row(5) << 0, 0, 0.01;  // an obstacle that moves becomes a part of the zone
    contact.detect(x, push, { 1e-4, 1e-4 });
    EXPECT_FALSE(merge_impact_zones(contact.pairs(), cloth_vertices, x, push, 1e-4).isZero(0));
}

// As in mirrored clothes, whose sheets have edges in the plane of the mirror: rounding alone would say how far apart they
// are, and hold them together for ever.
TEST(Contact, ClothThatTouchesButForRoundingHasNoSide)
{
    for (const double gap : { 0.0, 1e-18, 1e-12, 1e-6 }) {
        Positions x(8, 3);
        x << gap, -0.1, -0.1, gap, 0.1, 0.1, 0.5, 0, 0, -0.5, 0, 0,  // two triangles on a diagonal in x = 0
            0, -0.1, 0.1, 0, 0.1, -0.1, 0.5, 0.2, 0, -0.5, 0.2, 0;
        Triangles cloth(4, 3);
        cloth << 0, 1, 2, 1, 0, 3, 4, 5, 6, 5, 4, 7;
        ContactDetector contact({ cloth, edges_of(cloth), 8 }, { Triangles(0, 3), Edges(0, 2), 0 }, 0);
        contact.detect(x, Positions::Zero(8, 3), { 1e-3, 0 });
        const bool has_diagonals = std::any_of(contact.pairs().begin(), contact.pairs().end(), [](const auto& pair) {
            return pair.kind == PairKind::edge_edge && pair.vertices == std::array { 0, 1, 4, 5 };
        });
        EXPECT_EQ(has_diagonals, gap > 1e-9) << gap;
    }
}

// Four triangles above each other, 1 mm apart: a layer, the body, and two of the cloth.
TEST(Contact, APairTellsWhetherItIsWithTheBodyALayerOrTheClothItself)
{
    const Triangles two = (Triangles(2, 3) << 0, 1, 2, 3, 4, 5).finished();
    Positions x(12, 3);
    for (int t = 0; t < 4; ++t) {
        const double y = 1e-3 * std::array { 0, 1, -1, -2 }[t];
        x.middleRows(3 * t, 3) << 0, y, 0, 1, y, 0, 0, y, 1;
    }
    ContactDetector contact({ two, edges_of(two), 6 }, { two, edges_of(two), 6 }, 3);
    contact.detect(x, Positions::Zero(12, 3), { 2.1e-3, 0 });
    std::set<ContactReason> reasons;
    for (const ContactPair& pair : contact.pairs()) {
        const int last = *std::max_element(pair.vertices.begin(), pair.vertices.end());
        EXPECT_EQ(pair.reason, last < 6 ? ContactReason::self : last < 9 ? ContactReason::body : ContactReason::layer);
        reasons.insert(pair.reason);
    }
    EXPECT_EQ(reasons.size(), 3u);
}

TEST(BoxTree, FindsEachOverlappingPairOnceWithItselfAndWithAnother)
{
    std::srand(5);
    std::vector<Box> boxes;
    for (int i = 0; i < 300; ++i) {
        const Vec3 p = Vec3::Random();
        boxes.emplace_back(p, p + 0.2 * (Vec3::Random() + Vec3::Ones()));
    }
    const BoxTree tree(boxes), other(boxes);
    const auto found = [&](const BoxTree& b) {
        std::vector<std::vector<std::pair<int, int>>> parts(BoxTree::k_parts);
        BoxTree::overlaps(tree, b, [&](int part, int i, int j) { parts[part].emplace_back(i, j); });
        std::multiset<std::pair<int, int>> all;
        for (const auto& part : parts)
            all.insert(part.begin(), part.end());
        return all;
    };
    std::multiset<std::pair<int, int>> crosswise, within;
    for (int i = 0; i < 300; ++i)
        for (int j = 0; j < 300; ++j)
            if (boxes[i].intersects(boxes[j]))
                crosswise.emplace(i, j);
    for (const auto& [i, j] : found(tree))
        within.insert(std::minmax(i, j));
    EXPECT_EQ(found(other), crosswise);
    for (int i = 0; i < 300; ++i)
        crosswise.erase({ i, i });
    for (auto pair = crosswise.begin(); pair != crosswise.end();)
        pair = pair->first < pair->second ? std::next(pair) : crosswise.erase(pair);
    EXPECT_EQ(within, crosswise);
}

TEST(BoxTree, FindsThePairsOfWhatWasRenewedAlone)
{
    std::srand(6);
    const auto random_box = [] {
        const Vec3 p = Vec3::Random();
        return Box(p, p + 0.3 * (Vec3::Random() + Vec3::Ones()));
    };
    std::vector<Box> boxes(200);
    std::generate(boxes.begin(), boxes.end(), random_box);
    BoxTree tree(boxes);
    const auto is_changed = [](int i) { return i % 7 == 3; };
    tree.renew(is_changed, [&](int i) { return boxes[i] = random_box(); });
    std::set<std::pair<int, int>> found, expected;
    std::vector<std::vector<std::pair<int, int>>> parts(BoxTree::k_parts);
    BoxTree::overlaps(tree, tree, [&](int part, int i, int j) { parts[part].push_back(std::minmax(i, j)); });
    for (const auto& part : parts)
        found.insert(part.begin(), part.end());
    for (int i = 0; i < 200; ++i)
        for (int j = i + 1; j < 200; ++j)
            if ((is_changed(i) || is_changed(j)) && boxes[i].intersects(boxes[j]))
                expected.emplace(i, j);
    EXPECT_EQ(found, expected);
}

// Springs between the neighbours of a net of n by m knots, each knot held by a weak spring.
Eigen::SparseMatrix<double> net(int n, int m)
{
    Eigen::SparseMatrix<double> result(n * m, n * m);
    const auto join = [&](int i, int j) {
        result.coeffRef(i, i) += 1;
        result.coeffRef(j, j) += 1;
        result.coeffRef(i, j) -= 1;
        result.coeffRef(j, i) -= 1;
    };
    for (int r = 0; r < m; ++r)
        for (int c = 0; c < n; ++c) {
            result.coeffRef(r * n + c, r * n + c) += 0.1;
            if (c > 0)
                join(r * n + c, r * n + c - 1);
            if (r > 0)
                join(r * n + c, r * n + c - n);
        }
    return result;
}

TEST(SinglePrecisionFactor, SolvesForThreeRightSidesToSingleDigits)
{
    std::srand(1);
    for (const auto& system : { net(1, 1), net(40, 1), net(25, 30) }) {
        const Positions wanted = Positions::Random(system.rows(), 3);
        SinglePrecisionFactor factor;
        ASSERT_TRUE(factor.compute(system));
        EXPECT_LT((factor.solve(system * wanted) - wanted).cwiseAbs().maxCoeff(), 1e-4);
        ASSERT_TRUE(factor.compute(2 * system));
        EXPECT_LT((factor.solve(system * wanted) - 0.5 * wanted).cwiseAbs().maxCoeff(), 1e-4);
        EXPECT_FALSE(factor.compute(-system));
    }
}

TEST(ClothEnergy, AGarmentAtRestStays)
{
    const GarmentMesh cloth = tube(0.15);
    ClothEnergy energy(cloth, topology_of(cloth), {}, {});
    energy.set_time_step(0.02);
    PreconditionedCG solver(energy, cloth.positions, cloth.positions);
    solver.iterate();
    EXPECT_LT((solver.positions() - cloth.positions).cwiseAbs().maxCoeff(), 1e-9);
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
    ClothEnergy energy(cloth, topology_of(cloth), {}, {});
    energy.set_time_step(0.02);
    Positions x = 1.2 * cloth.positions;
    double strain = strain_of(cloth, x).median;
    for (int i = 0; i < 10; ++i) {
        const Positions here = x;
        PreconditionedCG solver(energy, here, here);
        for (int k = 0; k < 3; ++k)
            solver.iterate();
        x = solver.positions();
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
        ASSERT_GT(certificate.min_distance, 0);
    }
    EXPECT_GT(strain_of(cloth, motion.cloth()).max, 0.05);  // the tube was narrower than the ball
}

TEST(ClothMotion, MovesTheSameForAnyNumberOfThreads)
{
    const GarmentMesh cloth = tube(0.12, 24, 48);  // enough for several threads to get some
    const TriangleMesh unit = ball(1);
    const Positions target = 0.13 * unit.positions;
    const auto run = [&](int threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return tbb::task_arena(threads).execute([&] {
            ClothMotion motion(cloth, cloth.positions, { 0.1 * unit.positions, unit.triangles }, {});
            MotionStep step;
            step.obstacle_target = &target;
            step.largest_move = step.largest_obstacle_move = 0.01;
            for (int i = 0; i < 8; ++i)
                motion.advance(step);
            return motion.cloth();
        });
    };
    const Positions one = run(1);
    for (const int threads : { 2, 8, 8 })
        EXPECT_EQ(run(threads), one) << threads << " threads";
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
    // the armpit goes to the bone between spine and arm, the crotch to the root between the hips
    EXPECT_GT(core(0, 1), 1.38);
    EXPECT_LT((core.row(1).transpose() - s.root).norm(), 0.02);
}

}  // namespace
