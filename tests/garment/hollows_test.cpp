// SPDX-License-Identifier: GPL-3.0-or-later
#include "hollows.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "cloth_patches.h"
#include "fixtures.h"
#include "garment_openings.h"
#include "garmentfit/closed_ends.h"
#include "outward_cloth.h"

namespace garmentfit {
namespace {

/// m, to an upright elliptic cylinder, roughly; negative inside.
double cylinder(const Vec3& p, double x, double from, double to, double half_width, double half_depth)
{
    const double round = std::hypot((p.x() - x) / half_width, p.z() / half_depth) - 1;
    return std::max({ round * std::min(half_width, half_depth), from - p.y(), p.y() - to });
}

/// Trousers 0.8 m long as a solid, whose legs and waist are hollow to a depth, m.
double solid_trousers(const Vec3& p, double depth)
{
    double solid = cylinder(p, 0, 0.5, 0.8, 0.2, 0.12);
    double hollow = cylinder(p, 0, 0.8 - depth, 1, 0.17, 0.09);
    for (const double x : { -0.11, 0.11 }) {
        solid = std::min(solid, cylinder(p, x, 0, 0.6, 0.085, 0.085));
        hollow = std::min(hollow, cylinder(p, x, -0.1, depth, 0.06, 0.06));
    }
    return std::max(solid, -hollow);
}

TriangleMesh meshed(const std::function<double(const Vec3&)>& distance)
{
    return fixtures::polygonise(distance, Vec3(-0.26, -0.06, -0.18), Vec3(0.26, 0.96, 0.18), 0.015);
}

TriangleMesh trousers(double depth)
{
    return meshed([&](const Vec3& p) { return solid_trousers(p, depth); });
}

std::vector<Hollow> hollows_of(const TriangleMesh& solid)
{
    std::vector<int> all(std::size_t(solid.triangles.rows()));
    std::iota(all.begin(), all.end(), 0);
    return find_hollows(solid, all);
}

Vec3 middle_of(const TriangleMesh& mesh, const std::vector<int>& faces)
{
    Vec3 sum = Vec3::Zero();
    for (const int f : faces)
        sum += Vec3(mesh.positions(mesh.triangles.row(f), Eigen::all).colwise().mean());
    return sum / double(faces.size());
}

TEST(Hollows, AreWhereTheTubesOfASolidEnd)
{
    for (const double depth : { 0.03, 0.1 }) {
        const TriangleMesh solid = trousers(depth);
        const std::vector<Hollow> hollows = hollows_of(solid);
        ASSERT_EQ(hollows.size(), 3u) << depth;
        std::vector<Vec3> middles;
        for (const Hollow& hollow : hollows)
            middles.push_back(middle_of(solid, hollow.floor));
        std::sort(middles.begin(), middles.end(), [](const Vec3& a, const Vec3& b) { return a.x() < b.x(); });
        EXPECT_LT((middles[0] - Vec3(-0.11, depth, 0)).norm(), 0.03);
        EXPECT_LT((middles[1] - Vec3(0, 0.8 - depth, 0)).norm(), 0.05);
        EXPECT_LT((middles[2] - Vec3(0.11, depth, 0)).norm(), 0.03);
    }
}

TEST(Hollows, AreFoundInAnyPlaceSizeAndTurn)
{
    TriangleMesh solid = trousers(0.05);
    const Eigen::AngleAxisd turn(1, Vec3(1, 2, 3).normalized());
    solid.positions
        = (70 * solid.positions * turn.toRotationMatrix().transpose()).rowwise() + Eigen::RowVector3d(40, 50, 60);
    EXPECT_EQ(hollows_of(solid).size(), 3u);
}

TEST(Hollows, AreNotDimplesBehindWhichTheSolidIsThin)
{
    const TriangleMesh solid = meshed([](const Vec3& p) {
        const double dimple = (p - Vec3(0, 0.7, 0.12)).norm() - 0.07;
        return std::max(cylinder(p, 0, 0, 0.9, 0.2, 0.12), -dimple);
    });
    EXPECT_TRUE(hollows_of(solid).empty());
}

TEST(Hollows, AreNotGrooves)
{
    const TriangleMesh solid = meshed([](const Vec3& p) {
        const double groove = std::hypot(p.x(), p.z() - 0.12) - 0.04;
        return std::max(cylinder(p, 0, 0, 0.9, 0.2, 0.12), -std::max({ groove, 0.2 - p.y(), p.y() - 0.8 }));
    });
    EXPECT_TRUE(hollows_of(solid).empty());
}

GarmentMesh garment_of(const TriangleMesh& mesh) { return { mesh.positions, mesh.triangles }; }

TEST(HollowEnds, OfASolidLeaveOneLayerOfClothWithItsOpenings)
{
    const TriangleMesh solid = trousers(0.06);
    const OpenedGarment opened = open_ends(garment_of(solid));
    EXPECT_EQ(opened.closed_ends, 3);
    EXPECT_EQ(opened.garment.positions, solid.positions);
    EXPECT_LT(opened.garment.triangles.rows(), solid.triangles.rows());
    EXPECT_EQ(count_openings(opened.outside), 3u);
    EXPECT_EQ(outward_cloth(garment_of(solid)).triangles, opened.outside.triangles);
    const auto lining = lining_of(garment_of(solid), Lined::clothes_in_parts);
    ASSERT_TRUE(lining);
    EXPECT_EQ(lining->triangles, opened.outside.triangles);
}

/// Without its faces above a height.
TriangleMesh cut_off(const TriangleMesh& mesh, double height)
{
    std::vector<int> kept;
    for (int f = 0; f < int(mesh.triangles.rows()); ++f)
        if (mesh.positions(mesh.triangles.row(f), 1).maxCoeff() < height)
            kept.push_back(f);
    return weld_vertices({ mesh.positions, mesh.triangles(kept, Eigen::all) });
}

TEST(HollowEnds, OfClothThatIsOpenElsewhereAreLeftOut)
{
    const TriangleMesh cloth = cut_off(trousers(0.03), 0.75);
    const OpenedGarment opened = open_ends(garment_of(cloth));
    EXPECT_EQ(opened.closed_ends, 2);
    EXPECT_EQ(opened.outside.triangles.rows(), 0);
    EXPECT_EQ(count_openings(outward_cloth(garment_of(cloth))), 3u);
}

TEST(HollowEnds, AreNoneOfASolidWithoutHollows)
{
    const TriangleMesh ball = meshed([](const Vec3& p) { return (p - Vec3(0, 0.5, 0)).norm() - 0.15; });
    const OpenedGarment opened = open_ends(garment_of(ball));
    EXPECT_EQ(opened.closed_ends, 0);
    EXPECT_EQ(opened.garment.triangles, ball.triangles);
}

}  // namespace
}  // namespace garmentfit
