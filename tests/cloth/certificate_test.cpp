// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/certificate.h"

#include <gtest/gtest.h>

#include "fixtures.h"
#include "given_crossings.h"

namespace {

using namespace garmentfit;
using namespace garmentfit::fixtures;

TriangleMesh triangle(const Vec3& a, const Vec3& b, const Vec3& c)
{
    TriangleMesh mesh { Positions(3, 3), Triangles(1, 3) };
    mesh.positions << a.transpose(), b.transpose(), c.transpose();
    mesh.triangles << 0, 1, 2;
    return mesh;
}

TriangleMesh ball(double radius, const Vec3& centre = Vec3::Zero())
{
    TriangleMesh mesh
        = polygonise([&](const Vec3& p) { return p.norm() - radius; }, Vec3::Constant(-0.3), Vec3::Constant(0.3), 0.05);
    mesh.positions.rowwise() += centre.transpose();
    return mesh;
}

TEST(Certificate, CountsAnEdgeThroughATriangleOnce)
{
    const TriangleMesh flat = triangle({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 });
    const TriangleMesh spike = triangle({ 0.2, 0.2, -1 }, { 0.2, 0.2, 1 }, { 9, 9, 1 });
    ASSERT_EQ(crossings(spike, flat).size(), 1u);
    EXPECT_EQ(crossings(spike, flat).front().second, 0);
    EXPECT_TRUE(crossings(flat, triangle({ 0, 0, 1 }, { 1, 0, 1 }, { 0, 1, 1 })).empty());
}

TEST(Certificate, CallsABorderThatTouchesACrossing)
{
    const TriangleMesh flat = triangle({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 });
    EXPECT_EQ(crossings(triangle({ 0.5, 0, 0 }, { 0.5, -1, 1 }, { 0.5, -1, 2 }), flat).size(), 2u);
}

TEST(Certificate, DoesNotCountNeighboursAsCrossings)
{
    EXPECT_TRUE(self_crossings(ball(0.2)).empty());
    const TriangleMesh apart = joined(ball(0.2), ball(0.1));
    EXPECT_TRUE(self_crossings(apart).empty());
    EXPECT_FALSE(self_crossings(joined(ball(0.2), ball(0.2, Vec3(0.1, 0, 0)))).empty());
}

TEST(Certificate, FindsAGarmentThatLiesInsideTheBodyWithoutCrossingIt)
{
    const TriangleMesh body = ball(0.2), inner = ball(0.1), outer = ball(0.25);
    const GarmentMesh hidden { inner.positions, inner.triangles }, worn { outer.positions, outer.triangles };
    const Certificate bad = certify(body, hidden, hidden.positions), good = certify(body, worn, worn.positions);
    EXPECT_EQ(bad.body_crossings, 0);
    EXPECT_EQ(bad.vertices_inside, inner.positions.rows());
    EXPECT_FALSE(bad.clean());
    EXPECT_TRUE(good.clean());
    EXPECT_GT(good.min_distance, 0.02);  // the balls are polyhedra
    EXPECT_LT(good.min_distance, 0.05);
}

TEST(Certificate, CountsEachVertexInsideWhereFacesShareNone)
{
    const TriangleMesh body = ball(0.2), inner = ball(0.1), outer = ball(0.25);
    const auto apart = [](const TriangleMesh& mesh) {
        GarmentMesh result { Positions(3 * mesh.triangles.rows(), 3), mesh.triangles };
        for (int corner = 0; corner < int(result.positions.rows()); ++corner) {
            result.positions.row(corner) = mesh.positions.row(mesh.triangles(corner / 3, corner % 3));
            result.triangles(corner / 3, corner % 3) = corner;
        }
        return result;
    };
    const GarmentMesh hidden = apart(inner), both = apart(joined(inner, outer));
    EXPECT_EQ(certify(body, hidden, hidden.positions).vertices_inside, hidden.positions.rows());
    EXPECT_EQ(certify(body, both, both.positions).vertices_inside, hidden.positions.rows());
}

TEST(Certificate, ForgivesOnlyTheSelfCrossingsThatTheInputHad)
{
    const TriangleMesh two = joined(ball(0.1), ball(0.1, Vec3(0.103, 0.007, 0.011)));
    const GarmentMesh rest { two.positions, two.triangles };
    const TriangleMesh body = ball(0.05, Vec3(0, 0, 2));
    EXPECT_GT(certify(body, rest, rest.positions).input_self_crossings, 0);
    EXPECT_TRUE(certify(body, rest, rest.positions).clean());
    EXPECT_EQ(certify(body, rest, rest.positions).kept_self_crossings, self_crossings(two));

    const TriangleMesh apart = joined(ball(0.1), ball(0.1, Vec3(0.4, 0, 0)));
    EXPECT_GT(certify(body, { apart.positions, apart.triangles }, two.positions).self_crossings, 0);
    EXPECT_TRUE(certify(body, { apart.positions, apart.triangles }, two.positions).kept_self_crossings.empty());
}

TEST(Certificate, KnowsNoCrossingWhereTheInputOnlyTouched)
{
    // the edge of the spike passes exactly through the border that two triangles share, later beside it
    TriangleMesh mesh { Positions(7, 3), Triangles(3, 3) };
    mesh.positions << 0, 0, 0, 1, 0, 0, 0.5, 1, 0, 0.5, -1, 0, 0.5, 0, -1, 0.5, 0, 1, 9, 9, 1;
    mesh.triangles << 0, 1, 2, 1, 0, 3, 4, 5, 6;
    const TriangleMesh body = ball(0.05, Vec3(0, 0, 5));
    EXPECT_GT(certify(body, { mesh.positions, mesh.triangles }, mesh.positions).input_self_crossings, 0);
    Positions moved = mesh.positions;
    moved.bottomRows(3).col(1).array() += 0.1;
    EXPECT_GT(certify(body, { mesh.positions, mesh.triangles }, moved).self_crossings, 0);
}

TEST(Certificate, KnowsACurveThatPassesExactlyThroughAnEdge)
{
    // three spikes through a square of two triangles; that in the middle exactly through their common border
    TriangleMesh mesh { Positions(13, 3), Triangles(5, 3) };
    mesh.positions << 0, 0, 0, 1, 0, 0, 0.5, 1, 0, 0.5, -1, 0, 0.5, 0, -1, 0.5, 0, 1, 0.5, 0.9, -1,  //
        0.4, 0.3, -1, 0.4, 0.3, 1, 0.4, 9, 1, 0.6, -0.3, -1, 0.6, -0.3, 1, 0.6, -9, 1;
    mesh.triangles << 0, 1, 2, 1, 0, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12;
    const TriangleMesh body = ball(0.05, Vec3(0, 0, 5));
    const auto after = [&](const Vec3& move) {
        Positions moved = mesh.positions;
        moved.middleRows(4, 3).rowwise() += move.transpose();
        moved.bottomRows(3).col(0).array() += 5;  // one spike fewer: never more crossings than as given
        return certify(body, { mesh.positions, mesh.triangles }, moved).self_crossings;
    };
    EXPECT_EQ(after({ 0.01, 0.05, 0 }), 0) << "along its curve into the triangle that it surely crosses";
    EXPECT_GT(after({ 0.01, -0.05, 0 }), 0) << "into the triangle that it only touched";
}

/// Two sheets of 1 m that lie on each other, one of them tilted about a line across, along which they cross.
/// @param line  m, where it is
TriangleMesh doubled_sheet(double line)
{
    constexpr int n = 60;
    constexpr double tilt = 5e-4, spacing = 1. / (n - 1);
    TriangleMesh lower = flat(n, spacing, Vec3::Zero()), upper = lower;
    upper.positions.rowwise() += Eigen::RowVector3d(0.2 * spacing, 0, 0.3 * spacing);  // so that no edge meets an edge
    upper.positions.col(1) = tilt * (upper.positions.col(0).array() - line);
    return joined(lower, upper);
}

TEST(Certificate, FollowsACurveThatWentOnBetweenSheetsThatLieOnEachOther)
{
    const TriangleMesh given = doubled_sheet(0.503), body = ball(0.05, Vec3(0, 5, 0));
    const GarmentMesh rest { given.positions, given.triangles };
    const auto crossed_at = [&](double line) { return certify(body, rest, doubled_sheet(line).positions); };
    EXPECT_EQ(crossed_at(0.503).shifted_self_crossings, 0);
    const Certificate near = crossed_at(0.523);
    EXPECT_GT(near.shifted_self_crossings, 0);
    EXPECT_TRUE(near.clean());
    EXPECT_TRUE(crossed_at(0.6).clean());
}

/// The same, with the upper sheet 5 mm above the lower one beyond .8 m.
TriangleMesh partly_doubled_sheet(double line)
{
    TriangleMesh mesh = doubled_sheet(line);
    for (Eigen::Index v = mesh.positions.rows() / 2; v < mesh.positions.rows(); ++v)
        if (mesh.positions(v, 0) > 0.8)
            mesh.positions(v, 1) += 5e-3;
    return mesh;
}

TEST(Certificate, CallsCrossingsNewOfSheetsThatLayApart)
{
    const TriangleMesh given = partly_doubled_sheet(0.503), body = ball(0.05, Vec3(0, 5, 0));
    const auto crossed_at = [&](double line) {
        return certify(body, { given.positions, given.triangles }, doubled_sheet(line).positions).self_crossings;
    };
    EXPECT_EQ(crossed_at(0.6), 0);
    EXPECT_GT(crossed_at(0.9), 0);
}

TEST(Certificate, CallsCrossingsNewThatAreMoreThanTheGivenOnes)
{
    const TriangleMesh given = doubled_sheet(0.503), body = ball(0.05, Vec3(0, 5, 0));
    Positions moved = doubled_sheet(0.523).positions;
    const int n = int(moved.rows()) / 2;
    for (int v = n; v < 2 * n; v += 7)  // up and down through the lower sheet
        moved(v, 1) *= -1;
    const Certificate more = certify(body, { given.positions, given.triangles }, moved);
    EXPECT_EQ(more.shifted_self_crossings, 0);
    EXPECT_GT(more.self_crossings, more.input_self_crossings);
}

TEST(GivenCrossings, TellThoseOfClothThatLayApartHoweverManyThereAre)
{
    const TriangleMesh doubled = doubled_sheet(0.503), partly = partly_doubled_sheet(0.503);
    Positions moved = doubled_sheet(0.523).positions;
    const Eigen::Index half = moved.rows() / 2;
    for (Eigen::Index v = half; v < 2 * half; v += 7)  // up and down through the lower sheet
        moved(v, 1) *= -1;
    const Edges edges = edges_of(doubled.triangles);
    const std::vector<Crossing> crossings = self_crossings(TriangleMesh { moved, doubled.triangles });
    const auto count_apart = [&](const TriangleMesh& given, const std::vector<Crossing>& known) {
        return GivenCrossings(given, edges, known).of_cloth_apart(moved, crossings).size();
    };
    EXPECT_EQ(count_apart(doubled, self_crossings(doubled)), 0);
    EXPECT_EQ(count_apart(doubled, {}), crossings.size()) << "given without any";
    const std::size_t apart = count_apart(partly, self_crossings(partly));
    EXPECT_GT(apart, 0);
    EXPECT_LT(apart, crossings.size());
}

TEST(Certificate, MeasuresStrainAgainstTheRestLengths)
{
    const TriangleMesh mesh = ball(0.2);
    const Strain strain = strain_of({ mesh.positions, mesh.triangles }, 1.1 * mesh.positions);
    EXPECT_NEAR(strain.median, 0.1, 1e-9);
    EXPECT_NEAR(strain.max, 0.1, 1e-9);
}

TEST(Certificate, CountsLayersApartFromTheBody)
{
    const TriangleMesh body = ball(0.05, Vec3(0, 0, 2)), under = ball(0.2), over = ball(0.2, Vec3(0.1, 0, 0));
    const Certificate certificate = certify(body, { over.positions, over.triangles }, over.positions, { under });
    EXPECT_GT(certificate.layer_crossings, 0);
    EXPECT_EQ(certificate.body_crossings, 0);
    EXPECT_FALSE(certificate.clean());
}

}  // namespace
