// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/mesh.h"

#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "append_mesh.h"
#include "fixtures.h"
#include "garmentfit/error.h"
#include "warps.h"
#include "weld.h"

namespace {

using namespace garmentfit;
using fixtures::uvs_of;

TriangleMesh ball(const Vec3& centre, double radius, double spacing)
{
    const Vec3 corner = Vec3::Constant(radius + 2 * spacing);
    return fixtures::polygonise([&](const Vec3& p) { return (p - centre).norm() - radius; }, centre - corner,
                                centre + corner, spacing);
}

/// Every directed edge once, and its opposite too.
bool is_closed(const TriangleMesh& mesh)
{
    std::set<std::pair<int, int>> edges;
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k)
            if (!edges.insert({ mesh.triangles(f, k), mesh.triangles(f, (k + 1) % 3) }).second)
                return false;
    for (const auto& [a, b] : edges)
        if (edges.count({ b, a }) == 0)
            return false;
    return true;
}

double volume(const TriangleMesh& mesh)
{
    double sum = 0;
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
        const Vec3 a = mesh.positions.row(mesh.triangles(f, 0)), b = mesh.positions.row(mesh.triangles(f, 1)),
                   c = mesh.positions.row(mesh.triangles(f, 2));
        sum += a.dot(b.cross(c)) / 6;
    }
    return sum;
}

TriangleMesh without_first_faces(const TriangleMesh& mesh, int count)
{
    return { mesh.positions, mesh.triangles.bottomRows(mesh.triangles.rows() - count) };
}

TriangleMesh soup_of(const TriangleMesh& mesh)
{
    TriangleMesh soup;
    soup.positions.resize(3 * mesh.triangles.rows(), 3);
    soup.triangles.resize(mesh.triangles.rows(), 3);
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            soup.positions.row(3 * f + k) = mesh.positions.row(mesh.triangles(f, k));
            soup.triangles(f, k) = int(3 * f + k);
        }
    return soup;
}

BodyMesh body_of(const TriangleMesh& mesh) { return make_body(mesh.positions, mesh.triangles); }

TEST(MakeBody, KeepsAClosedSurfaceBitForBit)
{
    const TriangleMesh mesh = ball(Vec3(0, 1, 0), 0.5, 0.1);
    const BodyMesh body = body_of(mesh);
    EXPECT_FALSE(body.repaired);
    EXPECT_EQ(body.closed.positions, mesh.positions);
    EXPECT_EQ(body.closed.triangles, mesh.triangles);
}

TEST(MakeBody, TurnsASurfaceThatIsInsideOut)
{
    TriangleMesh mesh = ball(Vec3::Zero(), 0.5, 0.1);
    mesh.triangles.col(0).swap(mesh.triangles.col(1));
    const BodyMesh body = body_of(mesh);
    EXPECT_TRUE(body.repaired);
    EXPECT_GT(volume(body.closed), 0);
    EXPECT_EQ(body.surface.triangles, mesh.triangles);
}

TEST(MakeBody, FillsAHole)
{
    const TriangleMesh mesh = ball(Vec3::Zero(), 0.5, 0.1);
    const BodyMesh body = body_of(without_first_faces(mesh, 20));
    EXPECT_TRUE(body.repaired);
    EXPECT_TRUE(is_closed(body.closed));
    EXPECT_NEAR(volume(body.closed), volume(mesh), 0.03 * volume(mesh));
}

TEST(MakeBody, WeldsATriangleSoup)
{
    const TriangleMesh mesh = ball(Vec3::Zero(), 0.5, 0.1);
    const BodyMesh body = body_of(soup_of(mesh));
    EXPECT_TRUE(is_closed(body.closed));
    EXPECT_EQ(body.closed.positions.rows(), mesh.positions.rows());
    EXPECT_NEAR(volume(body.closed), volume(mesh), 1e-6);
    EXPECT_EQ(body.surface.positions.rows(), 3 * mesh.triangles.rows());
}

TEST(MakeBody, WeldsASoupWhoseCornersWereShaken)
{
    const TriangleMesh whole = ball(Vec3::Zero(), 0.5, 0.1);
    TriangleMesh soup { Positions(3 * whole.triangles.rows(), 3), Triangles(whole.triangles.rows(), 3) };
    for (int f = 0; f < int(whole.triangles.rows()); ++f)
        for (int k = 0; k < 3; ++k) {
            soup.triangles(f, k) = 3 * f + k;
            soup.positions.row(3 * f + k)
                = whole.positions.row(whole.triangles(f, k)) + 2e-5 * Vec3(f % 3 - 1, k - 1, f % 2).transpose();
        }
    const BodyMesh body = make_body(soup.positions, soup.triangles);
    EXPECT_TRUE(is_closed(body.closed));
    EXPECT_EQ(body.closed.positions.rows(), whole.positions.rows());
}

TEST(MakeBody, TakesTheFullPieceForTheBodyNotTheFloor)
{
    const TriangleMesh whole = ball(Vec3(0, 0.5, 0), 0.5, 0.1);
    TriangleMesh floor { Positions(4, 3), Triangles(2, 3) };
    floor.positions << -3, -0.01, -3, 3, -0.01, -3, 3, -0.01, 3, -3, -0.01, 3;
    floor.triangles << 0, 2, 1, 0, 3, 2;
    const TriangleMesh both = fixtures::joined(whole, floor);
    EXPECT_EQ(make_body(both.positions, both.triangles).closed.positions.rows(), whole.positions.rows());
}

TEST(MakeBody, LeavesIslandsOutOfTheClosedSurfaceAndKeepsThemInTheUsersOwn)
{
    const TriangleMesh mesh = ball(Vec3::Zero(), 0.5, 0.1), eye = ball(Vec3(0.2, 0, 0), 0.05, 0.03);
    const TriangleMesh both = fixtures::joined(mesh, eye);
    const BodyMesh body = body_of(both);
    EXPECT_EQ(body.closed.positions.rows(), mesh.positions.rows());
    EXPECT_EQ(body.surface.positions, both.positions);
}

TEST(MakeBody, OrientsFacesThatDisagree)
{
    TriangleMesh mesh = ball(Vec3::Zero(), 0.5, 0.1);
    const double before = volume(mesh);
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); f += 3)
        std::swap(mesh.triangles(f, 0), mesh.triangles(f, 1));
    const BodyMesh body = body_of(mesh);
    EXPECT_TRUE(is_closed(body.closed));
    EXPECT_NEAR(volume(body.closed), before, 1e-9);
}

TEST(MakeBody, WrapsABodyThatComesInParts)
{
    const TriangleMesh lower = ball(Vec3(0, 0, 0), 0.3, 0.08), upper = ball(Vec3(0, 0.5, 0), 0.3, 0.08),
                       top = ball(Vec3(0, 1, 0), 0.3, 0.08);
    const BodyMesh body = body_of(fixtures::joined(fixtures::joined(lower, upper), top));
    EXPECT_TRUE(is_closed(body.closed));
    EXPECT_GT(body.closed.positions.col(1).maxCoeff(), 1.25);
    EXPECT_LT(body.closed.positions.col(1).minCoeff(), -0.25);
}

TEST(MakeBody, SurvivesAFlatSheetAndAFoldedOne)
{
    TriangleMesh sheet;
    sheet.positions.resize(4, 3);
    sheet.positions << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0;
    sheet.triangles.resize(2, 3);
    sheet.triangles << 0, 1, 2, 0, 2, 3;
    try {
        EXPECT_TRUE(is_closed(body_of(sheet).closed));
    } catch (const InvalidInput&) {
    }
}

TEST(MakeBody, RefusesWhatHasNoAreaOrIsBroken)
{
    TriangleMesh mesh = ball(Vec3::Zero(), 0.5, 0.2);
    EXPECT_THROW(make_body(mesh.positions, Triangles(0, 3)), InvalidInput);
    EXPECT_THROW(make_body(0 * mesh.positions, mesh.triangles), InvalidInput);
    TriangleMesh far_index = mesh;
    far_index.triangles(3, 1) = 99999;
    EXPECT_THROW(body_of(far_index), InvalidInput);
    mesh.positions(7, 2) = std::numeric_limits<double>::quiet_NaN();
    try {
        body_of(mesh);
        FAIL();
    } catch (const InvalidInput& error) {
        EXPECT_NE(std::string(error.what()).find("vertex 7"), std::string::npos);
    }
}

TEST(MakeGarment, KeepsOpenSurfacesAndRefusesDegenerateOnes)
{
    const TriangleMesh open = without_first_faces(ball(Vec3::Zero(), 0.5, 0.1), 20);
    EXPECT_EQ(make_garment(open.positions, open.triangles).triangles, open.triangles);
    EXPECT_THROW(make_garment(0 * open.positions, open.triangles), InvalidInput);
}

TEST(VertexNormals, PointOutOfABall)
{
    const TriangleMesh mesh = ball(Vec3::Zero(), 0.5, 0.1);
    const Positions normals = vertex_normals(mesh.positions, mesh.triangles);
    for (Eigen::Index v = 0; v < normals.rows(); ++v) {
        EXPECT_NEAR(normals.row(v).norm(), 1, 1e-12);
        EXPECT_GT(normals.row(v).dot(mesh.positions.row(v).normalized()), 0.8);
    }
}

TEST(EdgesOf, GivesEachEdgeOnceInOrder)
{
    Triangles two(2, 3);
    two << 0, 1, 2, 2, 1, 3;
    Eigen::Matrix<int, 5, 2, Eigen::RowMajor> edges;
    edges << 0, 1, 0, 2, 1, 2, 1, 3, 2, 3;
    EXPECT_EQ(edges_of(two), edges);
}

TEST(MakeBody, RefusesAVertexFarFromAllOthers)
{
    for (const double far : { 1e3, 1e30, 1e200 }) {
        TriangleMesh mesh = ball(Vec3(5, 0, 0), 0.5, 0.1);
        mesh.positions(17, 1) = far;
        try {
            make_body(mesh.positions, mesh.triangles);
            FAIL() << far;
        } catch (const InvalidInput& error) {
            EXPECT_EQ(error.code(), ErrorCode::degenerate_mesh);
            EXPECT_NE(std::string(error.what()).find("vertex 17 "), std::string::npos) << error.what();
        }
    }
}

TEST(MakeBody, RefusesWhatLiesWhereCoordinatesHaveLostTheirDigits)
{
    const TriangleMesh mesh = ball(Vec3::Zero(), 0.5, 0.1);
    const auto moved = [&](double by) {
        TriangleMesh far = mesh;
        far.positions.col(2).array() += by;
        return far;
    };
    const TriangleMesh far = moved(1e10), too_far = moved(-1e33);
    EXPECT_NO_THROW(make_body(far.positions, far.triangles));
    TriangleMesh torn = moved(1e10);
    for (Eigen::Index f = 0; f < torn.triangles.rows(); f += 3)
        torn.triangles.row(f) = torn.triangles.row(f + 1).eval();
    EXPECT_NO_THROW(make_body(torn.positions, torn.triangles));
    EXPECT_NO_THROW(make_garment(far.positions, far.triangles));
    fixtures::expect_invalid([&] { make_body(too_far.positions, too_far.triangles); }, "away from the origin");
    fixtures::expect_invalid([&] { make_garment(too_far.positions, too_far.triangles); }, "away from the origin");
}

TEST(MakeBody, DoesNotMindVerticesWithoutFacesFarAway)
{
    TriangleMesh mesh = ball(Vec3::Zero(), 0.5, 0.1);
    const Eigen::Index n = mesh.positions.rows();
    mesh.positions.conservativeResize(n + 1, 3);
    for (const double far : { 1e3, 1e30, 1e300, std::numeric_limits<double>::quiet_NaN() }) {
        mesh.positions.row(n).setConstant(far);
        const BodyMesh body = make_body(mesh.positions, mesh.triangles);
        EXPECT_EQ(body.surface.positions.topRows(n), mesh.positions.topRows(n));
        EXPECT_LT(body.surface.positions.row(n).norm(), 1) << far;
        EXPECT_EQ(body.closed.positions.rows(), n);
        EXPECT_TRUE(make_garment(mesh.positions, mesh.triangles).positions.allFinite());
    }
}

/// A square of 0.1 m in the plane z = 0, of two triangles.
TriangleMesh square()
{
    TriangleMesh mesh { Positions(4, 3), Triangles(2, 3) };
    mesh.positions << 0, 0, 0, 0.1, 0, 0, 0.1, 0.1, 0, 0, 0.1, 0;
    mesh.triangles << 0, 1, 2, 0, 2, 3;
    return mesh;
}

TEST(MakeGarment, TheWarpRunsAlongVWhereverTheChartLies)
{
    const TriangleMesh mesh = square();
    const GarmentMesh garment
        = make_garment(mesh.positions, mesh.triangles,
                       uvs_of(mesh, [](const Vec3& at) { return Eigen::RowVector2d(7 - 3 * at.y(), 1 + 3 * at.x()); }));
    ASSERT_EQ(garment.warps.rows(), 2);
    for (int f = 0; f < 2; ++f)
        EXPECT_NEAR(std::abs(warp_direction(garment, f).x()), 1, 1e-12);
    GarmentMesh turned = garment;  // the warp goes with the cloth
    turned.positions.col(2) = garment.positions.col(0);
    turned.positions.col(0).setZero();
    EXPECT_NEAR(std::abs(warp_direction(turned, 0).z()), 1, 1e-12);
}

TEST(MakeGarment, KnowsNoWarpWithoutTextureCoordinatesThatCanBeThreads)
{
    const TriangleMesh mesh = square();
    const auto warps = [&](const CornerUvs& uvs) { return make_garment(mesh.positions, mesh.triangles, uvs).warps; };
    EXPECT_EQ(warps({}).rows(), 0);
    EXPECT_EQ(warps(CornerUvs::Zero(1, 6)).rows(), 0) << "of other triangles";
    EXPECT_EQ(warps(CornerUvs::Zero(2, 6)).rows(), 0) << "all in one place";
    EXPECT_EQ(warps(CornerUvs::Constant(2, 6, NAN)).rows(), 0);
    EXPECT_EQ(warps(CornerUvs::Constant(2, 6, 1e308)).rows(), 0);
    const auto askew = [](const Vec3& at) { return Eigen::RowVector2d(at.x(), at.y() + at.x()); };
    EXPECT_EQ(warps(uvs_of(mesh, askew)).rows(), 0);
    CornerUvs half = uvs_of(mesh, [](const Vec3& at) { return Eigen::RowVector2d(at.x(), at.y()); });
    half.row(1).setConstant(NAN);
    const Warps known = warps(half);
    ASSERT_EQ(known.rows(), 2);
    EXPECT_FALSE(known.row(0).isZero());
    EXPECT_TRUE(known.row(1).isZero());
}

TEST(Weld, KeepsTheWarpOfTheTrianglesThatItKeeps)
{
    TriangleMesh mesh = square();
    mesh.triangles.row(0) << 0, 1, 1;  // goes
    const GarmentMesh garment
        = make_garment(mesh.positions, mesh.triangles,
                       uvs_of(mesh, [](const Vec3& at) { return Eigen::RowVector2d(at.x(), at.y()); }));
    const GarmentMesh cloth = Weld(garment).gather(garment);
    ASSERT_EQ(cloth.warps.rows(), cloth.triangles.rows());
    EXPECT_NEAR(std::abs(warp_direction(cloth, 0).y()), 1, 1e-12);
}

TEST(AppendMesh, GarmentsWithAndWithoutWarpsAreOne)
{
    const TriangleMesh mesh = square();
    const GarmentMesh plain = make_garment(mesh.positions, mesh.triangles),
                      woven
        = make_garment(mesh.positions, mesh.triangles,
                       uvs_of(mesh, [](const Vec3&at) { return Eigen::RowVector2d(at.x(), at.y()); }));
    GarmentMesh all = plain;
    append(all, plain);
    EXPECT_EQ(all.warps.rows(), 0);
    append(all, woven);
    append(all, plain);
    ASSERT_EQ(all.warps.rows(), 8);
    EXPECT_TRUE(all.warps.topRows(4).isZero());
    EXPECT_EQ(all.warps.middleRows(4, 2), woven.warps);
    EXPECT_TRUE(all.warps.bottomRows(2).isZero());
}

}  // namespace
