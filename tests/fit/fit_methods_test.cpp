// SPDX-License-Identifier: GPL-3.0-or-later

// The steps of the three methods: metrics, bounds, searches.

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "baselines/paper_metric.h"
#include "baselines/relaxation.h"
#include "baselines/surface_metric.h"
#include "clearance_field.h"
#include "clearance_search.h"
#include "crossing_tree.h"
#include "fixtures.h"
#include "garmentfit/error.h"
#include "garmentfit/rig_body.h"
#include "incremental_paper_metric.h"
#include "nearest.h"
#include "vertex_tree.h"

namespace {

using namespace garmentfit;
using namespace garmentfit::fixtures;

Positions random_points(int count, unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> coordinate(-1, 1);
    return Positions::NullaryExpr(count, 3, [&] { return coordinate(random); });
}

// A tube along y with outward normals: three rings of eight vertices.
GarmentMesh tube(double radius)
{
    Positions positions(24, 3);
    for (int i = 0; i < 24; ++i) {
        const double angle = 2 * 3.14159265358979323846 * (i % 8) / 8;
        positions.row(i) << radius * std::cos(angle), 0.2 * (i / 8), radius * std::sin(angle);
    }
    std::vector<Eigen::Vector3i> faces;
    for (int i = 0; i < 16; ++i) {
        const int next = i / 8 * 8 + (i + 1) % 8;
        faces.push_back({ i, i + 8, next });
        faces.push_back({ next, i + 8, next + 8 });
    }
    Triangles triangles(faces.size(), 3);
    for (std::size_t f = 0; f < faces.size(); ++f)
        triangles.row(f) = faces[f];
    return make_garment(positions, triangles);
}

Skeleton with_lowerback(const Vec3& head, const Vec3& tail)
{
    Skeleton joints = person_skeleton({});
    joints.root = head;
    joints.tails[lowerback] = tail;
    return joints;
}

TEST(NearestVertex, TreeAndScanAgreeOnEquallyNearPoints)
{
    Positions points = random_points(1000, 1);
    points.bottomRows(500) = points.topRows(500);  // each of them twice
    const NearestPoint tree(points);
    const VertexTree boxes(points);
    const PointScan scan(points);
    const Positions queries = random_points(300, 2);
    for (Eigen::Index q = 0; q < queries.rows(); ++q) {
        const int nearest = scan.index(queries.row(q));
        EXPECT_EQ(tree.index(queries.row(q)), nearest);
        EXPECT_EQ(boxes.index(queries.row(q), 10), nearest);
        EXPECT_EQ(boxes.index(queries.row(q), (points.row(nearest) - queries.row(q)).norm()), nearest);
    }
}

// Random triangles, as large as sleeves are wide, in a box of a metre.
TriangleMesh random_cloth(unsigned seed)
{
    const Positions corners = random_points(90, seed), shape = 0.3 * random_points(90, seed + 1);
    TriangleMesh cloth { corners, Triangles(30, 3) };
    for (int f = 0; f < 30; ++f) {
        cloth.positions.middleRows(3 * f, 3) = 0.5 * corners.row(f).replicate(3, 1) + shape.middleRows(3 * f, 3);
        cloth.triangles.row(f) << 3 * f, 3 * f + 1, 3 * f + 2;
    }
    return cloth;
}

class RandomCloth : public testing::TestWithParam<unsigned> {
protected:
    const TriangleMesh cloth
        = GetParam() == 0 ? TriangleMesh { tube(0.3).positions, tube(0.3).triangles } : random_cloth(GetParam());
    const Vec3 low = cloth.positions.colwise().minCoeff(), high = cloth.positions.colwise().maxCoeff();
    const ClothTree tree { cloth_patches(cloth, 0.015) };
    const MinMaxPyramid clearance { tree, low, high };
    const std::vector<ClearanceSample> samples { { Vec3(0, 0, 0), 0.1 },
                                                 { Vec3(0, 0.2, 0), 0.12 },
                                                 { Vec3(0.15, 0.2, 0), 0.05 } };
    const ClearanceSearch search { clearance, samples, Vec3(0, 1.5, 0) };
};
INSTANTIATE_TEST_SUITE_P(Seeds, RandomCloth, testing::Range(0u, 12u));

TEST_P(RandomCloth, CrossingsAreThoseOfTheSingleTriangles)
{
    const TriangleTree all(cloth);
    const CrossingTree boxes(cloth);
    const Positions ends = random_points(400, GetParam() + 100);
    int met = 0;
    for (Eigen::Index i = 0; i < ends.rows(); i += 2) {
        EXPECT_EQ(boxes.is_met(ends.row(i), ends.row(i + 1)), all.is_met(ends.row(i), ends.row(i + 1)));
        met += boxes.is_met(ends.row(i), ends.row(i + 1));
    }
    EXPECT_GT(met, 0);
    for (Eigen::Index f = 0; f < cloth.triangles.rows(); ++f) {  // along an edge, and touching a corner
        const Vec3 a = cloth.positions.row(cloth.triangles(f, 0)), b = cloth.positions.row(cloth.triangles(f, 1));
        EXPECT_TRUE(boxes.is_met(a, b));
        EXPECT_TRUE(boxes.is_met(a, a + Vec3(0, 0, 1)));
    }
}

TEST_P(RandomCloth, NoValueInABoxExceedsItsBound)
{
    const Positions numbers = random_points(4000, 100 + GetParam());
    for (int box = 0; box < 100; ++box) {
        const Vec3 centre = numbers.row(40 * box), half_size = 0.3 * Vec3(numbers.row(40 * box + 1)).cwiseAbs();
        const double bound = search.bound(centre, half_size);
        for (int i = 2; i < 40; ++i) {
            const Vec3 inside = centre + half_size.cwiseProduct(Vec3(numbers.row(40 * box + i)));
            EXPECT_LE(search.value(inside), bound + 1e-9);
        }
        EXPECT_NEAR(search.bound(centre, Vec3::Zero()), search.bound(centre, Vec3::Constant(1e-12)), 1e-6);
    }
}

TEST_P(RandomCloth, BranchAndBoundFindsTheBestOfAllPlaces)
{
    const double spacing = 0.1;
    const std::vector<Place> found = search.find_best(low, high, spacing, 0.2, 3);
    ASSERT_FALSE(found.empty());
    Eigen::Array3i parts = Eigen::Array3i::Ones();  // the grid of boxes halved until none is longer than `spacing`
    for (int axis = 0; axis < 3; ++axis)
        while ((high - low)[axis] / parts[axis] > spacing)
            parts[axis] *= 2;
    double best = -1e300;
    for (int x = 0; x < parts.x(); ++x)
        for (int y = 0; y < parts.y(); ++y)
            for (int z = 0; z < parts.z(); ++z)
                best = std::max(best,
                                search.value(low
                                             + (high - low)
                                                   .cwiseProduct(Vec3(x + 0.5, y + 0.5, z + 0.5))
                                                   .cwiseQuotient(parts.cast<double>().matrix())));
    EXPECT_GE(found[0].value, best - 1e-9);
    for (std::size_t i = 1; i < found.size(); ++i)
        EXPECT_LE(found[i].value, found[i - 1].value);
}

TEST_P(RandomCloth, TheErrorOfTheDistanceIsAtMostAPatch)
{
    const TriangleTree exact(cloth);
    const ClearanceField grid(cloth);
    const Positions numbers = random_points(200, 200 + GetParam());
    for (Eigen::Index q = 0; q < numbers.rows(); ++q) {
        const Vec3 place = 0.5 * (low + high) + 0.5 * (high - low).cwiseProduct(Vec3(numbers.row(q)));
        const double distance = exact.distance(place), patch = 0.015 * std::sqrt(3.0);
        EXPECT_LE(std::abs(tree.distance(place) - distance), patch + 0.1 * distance);
        EXPECT_LE(std::abs(grid.at(place).distance - distance), patch + 0.02 * std::sqrt(3.0));
    }
}

TEST(FastMethod, GivesTheSameBitsWithOneThreadAndWithEight)
{
    Rig rig;
    rig.skeleton = person_skeleton({ .arm_angle = 55 });
    const TriangleMesh cloth = garment_round(person_skeleton({ .arm_angle = 35 }), 0.03, [](const Vec3& p) {
        return p.y() > 0.85 && p.y() < 1.46 && std::abs(p.x()) < 0.5;
    });
    const GarmentMesh garment = make_garment(cloth.positions, cloth.triangles);
    const auto pose_by = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return fit_skeleton(rig, garment).pose;
    };
    const Pose one = pose_by(1), eight = pose_by(8);
    EXPECT_EQ(one.root_translation, eight.root_translation);
    for (int b = 0; b < bone_count; ++b)
        EXPECT_EQ(one.rotations[b].coeffs(), eight.rotations[b].coeffs()) << bone_name(b);
}

TEST(PaperMetric, CountsDistanceInsideAndAHundredTimesDistanceOutside)
{
    const GarmentMesh garment = tube(0.1);
    const PaperMetric metric(garment, { lowerback }, NearestSearch::scan);
    const Skeleton inside = with_lowerback({ 0, 0.2, 0 }, { 0, 0.2, 1e-9 });
    EXPECT_NEAR(metric.of_bone(lowerback, inside), 5 * 0.1, 1e-6);
    const Skeleton outside = with_lowerback({ 0.13, 0.2, 0 }, { 0.13, 0.2, 1e-9 });
    EXPECT_NEAR(metric.of_bone(lowerback, outside), -100 * 5 * 0.03, 1e-6);
    EXPECT_EQ(metric.total(inside), metric.of_bone(lowerback, inside));
}

TEST(IncrementalPaperMetric, ComparesPosturesAsThePapersMetricDoes)
{
    const GarmentMesh garment = tube(0.1);
    const PaperMetric metric(garment, { lowerback, upperback }, NearestSearch::scan);
    std::array<bool, bone_count> covered {};
    covered[lowerback] = covered[upperback] = true;
    IncrementalPaperMetric incremental({ garment.positions, garment.triangles }, covered);
    Skeleton present = with_lowerback({ 0, 0.1, 0 }, { 0, 0.3, 0.01 });
    EXPECT_TRUE(incremental.is_above(present, 0));
    incremental.accept();
    const Positions steps = 0.02 * random_points(4000, 3);
    int rises = 0;
    for (Eigen::Index i = 0; i < 2000; ++i) {
        Skeleton next = present;
        next.root += Vec3(steps.row(2 * i));
        next.tails[lowerback] += Vec3(steps.row(2 * i + 1));
        const bool is_above = metric.total(next) > metric.total(present);
        ASSERT_EQ(incremental.is_above(next, 0), is_above) << i;
        if (!is_above)
            continue;
        present = next;
        incremental.accept();
        EXPECT_NEAR(incremental.total(), metric.total(present), 1e-9);
        ++rises;
    }
    EXPECT_GT(rises, 10);
}

TEST(PaperMethod, FindsTheSameByScanAndByTree)
{
    const PersonOptions made_on { .arm_angle = 35 }, input { .arm_angle = 55 };
    Rig rig;
    rig.skeleton = person_skeleton(input);
    const TriangleMesh cloth = garment_round(
        person_skeleton(made_on), 0.03,
        [](const Vec3& p) { return p.y() > 0.85 && p.y() < 1.46 && std::abs(p.x()) < 0.5; }, 0.045);
    const GarmentMesh garment = make_garment(cloth.positions, cloth.triangles);
    const std::vector<Bone> covered = bones_covered_by(GarmentType::longsleeve);
    Relaxation relaxation = relaxation_of(rig, garment, GarmentType::longsleeve, 2);
    relaxation.translation_spacing *= 2;  // coarser, for a quick test
    relaxation.rotation_spacing = 0.1;
    relaxation.bone_spacing *= 2;
    const PaperMetric by_tree(garment, covered, NearestSearch::kd_tree), by_scan(garment, covered, NearestSearch::scan);
    const RelaxedPosture found = search_relaxed(rig, by_tree, covered, relaxation, {});
    const RelaxedPosture scanned = search_relaxed(rig, by_scan, covered, relaxation, {});
    EXPECT_EQ(found.posture.root, scanned.posture.root);
    EXPECT_EQ(found.posture.directions, scanned.posture.directions);
    EXPECT_EQ(found.bone_evaluations, scanned.bone_evaluations);
    EXPECT_GT(by_tree.total(place_bones(rig.skeleton, found.posture)),
              by_tree.total(place_bones(rig.skeleton, relaxation.start)));
}

TEST(SurfaceMetric, IsZeroWhereTheGarmentIsTheBodysOwnSkin)
{
    const Person person = capsule_person({ .spacing = 0.08 });
    const BodyMesh body = make_body(person.mesh.positions, person.mesh.triangles);
    const Rig rig = rig_body(body);
    const GarmentMesh garment = make_garment(person.mesh.positions, person.mesh.triangles);
    Posture posture { rig.skeleton.root, Eigen::Quaterniond::Identity(), {} };
    for (int b = 0; b < bone_count; ++b)
        posture.directions[b] = rig.skeleton.direction(b);
    const SurfaceMetric by_tree(rig, body.surface, garment, NearestSearch::kd_tree);
    const SurfaceMetric by_scan(rig, body.surface, garment, NearestSearch::scan);
    const double at_rest = by_tree.total(place_bones(rig.skeleton, posture));
    EXPECT_NEAR(at_rest, 0, 1e-6 * double(garment.positions.rows()));
    posture.root.x() += 0.02;
    const double moved = by_tree.total(place_bones(rig.skeleton, posture));
    EXPECT_LT(moved, at_rest - 1);
    EXPECT_EQ(moved, by_scan.total(place_bones(rig.skeleton, posture)));
}

TEST(SurfaceMethod, MovesTheBodyBackIntoItsSkin)
{
    const Person person = capsule_person({ .spacing = 0.12 });
    const BodyMesh body = make_body(person.mesh.positions, person.mesh.triangles);
    const Rig rig = rig_body(body);
    const GarmentMesh garment = make_garment(person.mesh.positions, person.mesh.triangles);
    const std::vector<Bone> covered { lhumerus };
    Relaxation relaxation = relaxation_of(rig, garment, GarmentType::jumpsuit, 2);
    relaxation.start.root = rig.skeleton.root + Vec3(0.05, 0, 0);
    relaxation.translation_extent = Vec3::Constant(0.1);
    relaxation.translation_spacing = 0.05;
    relaxation.rotation_spacing = relaxation.rotation_extent;
    relaxation.bone_spacing = 0.2;
    const SurfaceMetric metric(rig, body.surface, garment, NearestSearch::kd_tree);
    const RelaxedPosture found = search_relaxed(rig, metric, covered, relaxation, {});
    EXPECT_LT((found.posture.root - rig.skeleton.root).norm(), 0.03);
}

TEST(SurfaceMethod, RequiresTheBody)
{
    Rig rig;
    rig.skeleton = person_skeleton({});
    EXPECT_THROW(fit_skeleton(rig, tube(0.1), { .type = GarmentType::skirt, .method = FitMethod::tisserand }),
                 InvalidInput);
}

}  // namespace
