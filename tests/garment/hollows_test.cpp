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
#include "hollow_ends.h"
#include "nearest.h"
#include "outward_cloth.h"
#include "shut_neck.h"
#include "surface_measures.h"
#include "used_vertices.h"

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
    const NearestPoint kept(opened.garment.positions(used_vertices(opened.garment.triangles), Eigen::all));
    for (Eigen::Index v = 0; v < solid.positions.rows(); ++v)
        ASSERT_EQ(kept.distance(opened.garment.positions.row(v)), 0) << "floors are drawn to the cloth";
    EXPECT_LT(opened.garment.triangles.rows(), solid.triangles.rows());
    EXPECT_EQ(count_openings(opened.outside), 3u);
    EXPECT_EQ(outward_cloth(garment_of(solid)).triangles, opened.outside.triangles);
    const auto lining = lining_of(garment_of(solid), Lined::clothes_in_parts);
    ASSERT_TRUE(lining);
    EXPECT_EQ(lining->sheet.triangles, opened.outside.triangles);
}

/// A T-shirt 0.6 m long as a solid with flat ends, but for a dent 4 cm deep at the neck.
/// @param edge  m, radius of the edges of its flat ends
double solid_tshirt(const Vec3& p, double edge)
{
    const auto tube = [&](double across, double along, double half_width, double half_length) {
        const Eigen::Array2d beyond(across - half_width + edge, std::abs(along) - half_length + edge);
        return beyond.max(0).matrix().norm() + std::min(beyond.maxCoeff(), 0.0) - edge;
    };
    const double trunk = tube(0.1 * std::hypot(p.x() / 0.2, p.z() / 0.1), p.y() - 0.3, 0.1, 0.3);
    const double sleeves = tube(std::hypot(p.y() - 0.48, p.z()), p.x(), 0.075, 0.36);
    const double neck = std::max(std::hypot(p.x(), p.z()) - 0.07, 0.56 - p.y());
    return std::max(std::min(trunk, sleeves), -neck);
}

TEST(SolidEnds, AreFlatAsWellAsHollow)
{
    for (const double edge : { 0.001, 0.01 }) {
        const TriangleMesh solid = fixtures::polygonise([&](const Vec3& p) { return solid_tshirt(p, edge); },
                                                        Vec3(-0.4, -0.06, -0.18), Vec3(0.4, 0.66, 0.18), 0.015);
        const OpenedGarment opened = open_ends(garment_of(solid));
        EXPECT_EQ(opened.closed_ends, 4) << edge;
        EXPECT_EQ(count_openings(opened.outside), 4u) << edge;
    }
}

/// A T-shirt 0.6 m long as a solid with sloping shoulders, whose neck is filled up to a groove round it.
/// @param groove  m, how wide; without any the shoulders meet in a ridge
TriangleMesh tshirt_with_filled_neck(double groove)
{
    const auto solid = [&](const Vec3& p) {
        const Vec3 along_sleeves(p.z(), std::abs(p.x()), p.y() - 0.45);
        const double trunk = std::max(cylinder(p, 0, 0, 0.7, 0.2, 0.12), 0.85 * (p.y() + 0.6 * std::abs(p.x()) - 0.6));
        const double shirt = std::min(trunk, cylinder(along_sleeves, 0, 0, 0.4, 0.075, 0.075));
        const double round = std::hypot(p.x(), p.z()) - 0.07;
        const double above = std::max(round - groove, 0.54 - p.y()), filling = std::max(round, p.y() - 0.56);
        return groove == 0 ? shirt : std::min(std::max(shirt, -above), filling);
    };
    return fixtures::polygonise(solid, Vec3(-0.44, -0.06, -0.18), Vec3(0.44, 0.66, 0.18), 0.01);
}

std::vector<int> shut_neck_of(const TriangleMesh& tshirt)
{
    return find_shut_neck(tshirt, { Vec3(0, 0, 0), Vec3(0, 0.45, 0), Vec3::UnitY(), Vec3::UnitX(), 0.8, 0.075 });
}

TEST(ShutNeck, IsTheSmoothPatchInACollar)
{
    const TriangleMesh tshirt = tshirt_with_filled_neck(0.02);
    const std::vector<int> neck = shut_neck_of(tshirt);
    double covered = 0;  // m^2
    for (const int f : neck) {
        const Vec3 middle = tshirt.positions(tshirt.triangles.row(f), Eigen::all).colwise().mean();
        EXPECT_LT(std::hypot(middle.x(), middle.z()), 0.08);
        EXPECT_GT(middle.y(), 0.53);
        covered += area_vector(tshirt.positions, tshirt.triangles, f).y();
    }
    EXPECT_NEAR(covered, 3.14 * 0.07 * 0.07, 0.15 * 3.14 * 0.07 * 0.07);
}

TEST(ShutNeck, IsNoneOfShouldersWithoutACollar) { EXPECT_TRUE(shut_neck_of(tshirt_with_filled_neck(0)).empty()); }

/// m, to all places within a distance of an upright line through the origin.
double capsule(const Vec3& p, double from, double to, double distance)
{
    return (p - Vec3(0, std::clamp(p.y(), from, to), 0)).norm() - distance;
}

/// A T-shirt as a solid with flat ends and a hood that stands up, open in front, and filled at the neck by a dome.
TriangleMesh tshirt_with_filled_hood()
{
    const auto solid = [](const Vec3& p) {
        const Vec3 along_sleeves(p.z(), std::abs(p.x()), p.y() - 0.45);
        const double trunk = std::max(cylinder(p, 0, 0, 0.7, 0.2, 0.12), 0.85 * (p.y() + 0.6 * std::abs(p.x()) - 0.6));
        const double shirt = std::min(trunk, cylinder(along_sleeves, 0, 0, 0.4, 0.075, 0.075));
        const double face = std::max({ std::abs(p.x()) - 0.07, p.y() - 0.78, -p.z() });
        const double below_dome = 0.6 - 2 * (p.x() * p.x() + p.z() * p.z()) - p.y();
        const double inside = std::max(std::min(capsule(p, 0.5, 0.74, 0.1), face), below_dome);
        return std::max(std::min(shirt, capsule(p, 0.5, 0.74, 0.12)), -inside);
    };
    return fixtures::polygonise(solid, Vec3(-0.44, -0.06, -0.18), Vec3(0.44, 0.9, 0.18), 0.01);
}

TEST(ShutNeck, IsTheFloorOfAHood)
{
    const TriangleMesh tshirt = tshirt_with_filled_hood();
    const std::vector<int> neck = shut_neck_of(tshirt);
    double covered = 0;  // m^2
    for (const int f : neck) {
        const Vec3 middle = tshirt.positions(tshirt.triangles.row(f), Eigen::all).colwise().mean();
        EXPECT_LT(middle.y(), 0.61);
        covered += area_vector(tshirt.positions, tshirt.triangles, f).y();
    }
    EXPECT_NEAR(covered, 3.14 * 0.1 * 0.1, 0.15 * 3.14 * 0.1 * 0.1);
}

TEST(SolidEnds, AreNoneOfACylinder)
{
    const TriangleMesh solid = meshed([](const Vec3& p) { return cylinder(p, 0, 0, 0.9, 0.2, 0.12); });
    EXPECT_EQ(open_ends(garment_of(solid)).closed_ends, 0);
}

/// Its faces between two heights, m.
TriangleMesh between(double low, double high, const TriangleMesh& mesh)
{
    std::vector<int> kept;
    for (int f = 0; f < int(mesh.triangles.rows()); ++f) {
        const Eigen::VectorXd heights = mesh.positions(mesh.triangles.row(f), 1);
        if (heights.minCoeff() > low && heights.maxCoeff() < high)
            kept.push_back(f);
    }
    return weld_vertices({ mesh.positions, mesh.triangles(kept, Eigen::all) });
}

/// Without its hem and the ends of its sleeves.
TriangleMesh open_tshirt_with_filled_hood()
{
    TriangleMesh tshirt = between(0.02, 1, tshirt_with_filled_hood());
    tshirt.positions.col(0).swap(tshirt.positions.col(1));
    tshirt = between(-0.38, 0.38, tshirt);
    tshirt.positions.col(0).swap(tshirt.positions.col(1));
    return tshirt;
}

TEST(ClosedNeck, IsLeftOutWhereHemAndSleevesAreOpen)
{
    const TriangleMesh tshirt = open_tshirt_with_filled_hood();
    ASSERT_EQ(count_openings(tshirt), 3u);
    EXPECT_EQ(find_closed_neck(garment_of(tshirt)).faces.size(), 1u);
}

TEST(ClosedNeck, IsLeftOutWhereHemAndSleevesAreCapped)
{
    const TriangleMesh tshirt = fill_openings(open_tshirt_with_filled_hood());
    EXPECT_EQ(open_ends(garment_of(tshirt)).closed_ends, 4);
    EXPECT_EQ(count_openings(outward_cloth(garment_of(tshirt))), 4u);
}

TEST(ClosedNeck, IsNoneOfTrousers)
{
    const TriangleMesh cloth = between(0.02, 0.78, meshed([](const Vec3& p) { return solid_trousers(p, 0); }));
    ASSERT_EQ(count_openings(cloth), 3u);
    EXPECT_TRUE(find_closed_neck(garment_of(cloth)).faces.empty());
}

TEST(HollowEnds, OfClothThatIsOpenElsewhereAreLeftOut)
{
    const TriangleMesh cloth = between(-1, 0.75, trousers(0.03));
    const OpenedGarment opened = open_ends(garment_of(cloth));
    EXPECT_EQ(opened.closed_ends, 2);
    const NearestPoint kept(opened.garment.positions(used_vertices(opened.garment.triangles), Eigen::all));
    for (Eigen::Index v = 0; v < cloth.positions.rows(); ++v)
        ASSERT_EQ(kept.distance(opened.garment.positions.row(v)), 0) << "floors are drawn to the cloth";
    EXPECT_EQ(opened.outside.triangles.rows(), 0);
    EXPECT_EQ(count_openings(outward_cloth(garment_of(cloth))), 3u);
}

/// A shirt 0.56 m long, open at hem and neck, whose sleeves end in cones. @param slope  of the sleeves, rad
/// @param end  m, of the sleeves, where they are level
TriangleMesh shirt_with_closed_sleeves(double slope = 0, double end = 0.4)
{
    const auto solid = [&](const Vec3& p) {
        const double out = std::abs(p.x()) - 0.17, up = p.y() - 0.5;
        const Vec3 along_sleeves(p.z(), 0.17 + std::cos(slope) * out - std::sin(slope) * up,
                                 std::sin(slope) * out + std::cos(slope) * up);
        const double shirt
            = std::min(cylinder(p, 0, 0, 0.6, 0.2, 0.12), cylinder(along_sleeves, 0, 0, end, 0.07, 0.07));
        return std::max(shirt, along_sleeves.y() - end + 0.04 - std::hypot(along_sleeves.z(), p.z()));
    };
    return between(0.02, 0.58, fixtures::polygonise(solid, Vec3(-0.46, -0.06, -0.18), Vec3(0.46, 0.66, 0.18), 0.015));
}

TEST(HollowEnds, OfBothSleevesAreLeftOutWhereHemAndNeckAreOpen)
{
    const TriangleMesh shirt = shirt_with_closed_sleeves();
    ASSERT_EQ(count_openings(shirt), 2u);
    EXPECT_EQ(open_ends(garment_of(shirt)).closed_ends, 2);
    EXPECT_EQ(count_openings(outward_cloth(garment_of(shirt))), 4u);
}

TEST(HollowEnds, OfBothSleevesAreLeftOutWhereAPrintLiesOnTheCloth)
{
    TriangleMesh print = fixtures::sheet(16, 0.02, [](double, double) { return 0; });
    for (auto row : print.positions.rowwise())  // on the back
        row = Eigen::RowVector3d(row.x() - 0.15, 0.1 + row.z(), -0.13);
    const TriangleMesh shirt = fixtures::joined(shirt_with_closed_sleeves(), print);
    ASSERT_EQ(count_openings(shirt), 3u);
    EXPECT_EQ(open_ends(garment_of(shirt)).closed_ends, 2);
}

TEST(HollowEnds, OfBothSleevesAreLeftOutWhereTheyHang)
{
    const TriangleMesh shirt = shirt_with_closed_sleeves(1.1, 0.6);
    ASSERT_EQ(count_openings(shirt), 2u);
    EXPECT_EQ(open_ends(garment_of(shirt)).closed_ends, 2);
    EXPECT_EQ(count_openings(outward_cloth(garment_of(shirt))), 4u);
}

TEST(HollowEnds, OfSleevesAreBothOrNone)
{
    EXPECT_EQ(find_closed_sleeves(garment_of(shirt_with_closed_sleeves())).faces.size(), 2u);
    EXPECT_TRUE(find_closed_sleeves(garment_of(between(-1, 0.75, trousers(0.03)))).faces.empty());
}

TEST(HollowEnds, AreLeftOutWithTheFoldsInThem)
{
    TriangleMesh shirt = shirt_with_closed_sleeves();
    const auto is_fold = [](const Vec3& p) { return std::abs(p.x()) > 0.35 && std::hypot(p.y() - 0.5, p.z()) < 0.016; };
    std::vector<int> fold;
    for (int v = 0; v < int(shirt.positions.rows()); ++v)
        if (is_fold(shirt.positions.row(v)))
            fold.push_back(v);
    for (const int v : fold)
        shirt.positions(v, 0) += shirt.positions(v, 0) > 0 ? 0.03 : -0.03;
    ASSERT_GE(fold.size(), 4u);
    const OpenedGarment opened = open_ends(garment_of(shirt));
    EXPECT_EQ(opened.closed_ends, 2);
    for (const int v : fold)
        EXPECT_FALSE((opened.garment.triangles.array() == v).any()) << "it floats in the cuff";
}

TEST(HollowEnds, AreNotFoldsOfASkirt)
{
    const TriangleMesh skirt
        = between(0.03, 0.87, meshed([](const Vec3& p) {
                      const double fold = 0.025 * std::cos(8 * std::atan2(p.z(), p.x()));
                      return std::max({ std::hypot(p.x(), p.z()) - 0.12 - fold, -p.y(), p.y() - 0.9 });
                  }));
    ASSERT_EQ(count_openings(skirt), 2u);
    EXPECT_EQ(open_ends(garment_of(skirt)).closed_ends, 0);
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
