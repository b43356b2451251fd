// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/fit_map.h"

#include <gtest/gtest.h>

#include "fixtures.h"
#include "garmentfit/rig_body.h"

namespace {

using namespace garmentfit;
using namespace garmentfit::fixtures;

/// An open tube about the y axis, 40 cm long.
TriangleMesh tube(double radius)
{
    constexpr int n = 48, rows = 20;
    TriangleMesh mesh { Positions(n * (rows + 1), 3), Triangles(2 * n * rows, 3) };
    for (int r = 0; r <= rows; ++r)
        for (int k = 0; k < n; ++k)
            mesh.positions.row(r * n + k) << radius * std::cos(2 * M_PI * k / n), 0.02 * r,
                radius * std::sin(2 * M_PI * k / n);
    int f = 0;
    for (int r = 0; r < rows; ++r)
        for (int k = 0; k < n; ++k) {
            const int a = r * n + k, b = r * n + (k + 1) % n;
            mesh.triangles.row(f++) << a, a + n, b;
            mesh.triangles.row(f++) << b, a + n, b + n;
        }
    return mesh;
}

WornGarment stretched_tube(double rest_radius, double radius)
{
    const TriangleMesh rest = tube(rest_radius), worn = tube(radius);
    return { { rest.positions, rest.triangles }, worn.positions, {} };
}

double median(Eigen::VectorXd values)
{
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

TEST(FitMap, GivesTheGapToTheSkin)
{
    const FitMap map = fit_map(tube(0.1), stretched_tube(0.13, 0.13));
    EXPECT_NEAR(map.ease.minCoeff(), 0.03, 1e-3);
    EXPECT_NEAR(map.ease.maxCoeff(), 0.03, 1e-3);
    EXPECT_NEAR(map.strain.cwiseAbs().maxCoeff(), 0, 1e-9);
    EXPECT_EQ(map.pressure.maxCoeff(), 0);  // loose cloth presses on nothing
}

TEST(FitMap, GivesTheStretchOfTheEdgesAtAVertex)
{
    const FitMap map = fit_map(tube(0.1), stretched_tube(0.092, 0.102));
    const double round = 0.102 / 0.092 - 1;  // edges along the tube are not stretched, those round it are
    EXPECT_GT(median(map.strain), 0.2 * round);
    EXPECT_LT(median(map.strain), round);
}

TEST(FitMap, PressureIsTensionOverRadius)
{
    ClothOptions cloth;
    const double strain = 0.05, radius = 0.102;
    const FitMap map = fit_map(tube(0.1), stretched_tube(radius / (1 + strain), radius), cloth);
    const double expected = material_of(cloth).stretch_stiffness * strain / radius;  // Laplace: p = T / R
    EXPECT_NEAR(median(map.pressure), expected, 0.35 * expected);  // springs along edges are not quite isotropic
}

TEST(FitMap, PressureGrowsWithTheStretch)
{
    const double little = median(fit_map(tube(0.1), stretched_tube(0.1, 0.102)).pressure),
                 much = median(fit_map(tube(0.1), stretched_tube(0.09, 0.102)).pressure);
    EXPECT_GT(much, 3 * little);
}

TEST(FitMap, NamesThePartAtWhichEdgesAreOverstretched)
{
    const TriangleMesh body = tube(0.1);
    WornGarment worn = stretched_tube(0.1, 0.11);
    const SkinWeights weights = on_bone(lhumerus, body.positions.rows());
    const Overstretch fine = overstretch(weights, body.positions, worn);
    EXPECT_EQ(fine.edges, 0);
    EXPECT_NEAR(fine.largest, 0.1, 1e-9);
    EXPECT_EQ(fine.part, "");
    EXPECT_EQ(fine.gained, 0);
    worn.positions.row(100) += Eigen::RowVector3d(0, 0.05, 0);  // of an edge of 2 cm
    const Overstretch caught = overstretch(weights, body.positions, worn);
    EXPECT_GT(caught.edges, 1);
    EXPECT_GT(caught.largest, 2);
    EXPECT_GT(caught.gained, 0);
    EXPECT_LT(caught.gained, 0.05) << "that of the six triangles round one vertex";
    EXPECT_EQ(caught.part, "left upper arm");
}

TEST(FitMap, SeamsOfUvChartsDoNotMatter)
{
    WornGarment whole = stretched_tube(0.095, 0.102), cut = whole;
    const Eigen::Index n = whole.positions.rows(), faces = whole.rest.triangles.rows();
    for (Positions* positions : { &cut.positions, &cut.rest.positions }) {  // the last face gets vertices of its own
        positions->conservativeResize(n + 3, 3);
        for (int k = 0; k < 3; ++k)
            positions->row(n + k) = positions->row(whole.rest.triangles(faces - 1, k));
    }
    cut.rest.triangles.row(faces - 1) << int(n), int(n) + 1, int(n) + 2;
    const FitMap a = fit_map(tube(0.1), whole), b = fit_map(tube(0.1), cut);
    EXPECT_LT((a.pressure - b.pressure.head(n)).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LT((a.strain - b.strain.head(n)).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(FitMap, AVertexOfNoFaceHasTheValuesOfItsNeighbour)
{
    const WornGarment whole = stretched_tube(0.095, 0.102);
    WornGarment strewn = whole;
    const Eigen::Index n = whole.positions.rows();
    for (Positions* positions : { &strewn.positions, &strewn.rest.positions }) {
        positions->conservativeResize(n + 2, 3);
        positions->row(n) = 1.001 * positions->row(7);
        positions->row(n + 1) << 0, 1000, 0;
    }
    const FitMap a = fit_map(tube(0.1), whole), b = fit_map(tube(0.1), strewn);
    EXPECT_EQ(b.ease.head(n), a.ease);
    EXPECT_EQ(b.pressure.head(n), a.pressure);
    EXPECT_EQ(b.ease[n], a.ease[7]);
    EXPECT_LT(b.ease[n + 1], 0.01);
}

TEST(Spikes, AreEdgesOfTheBodyThatAreDrawnOutFarBeyondThePose)
{
    const Person person = capsule_person({});
    const BodyMesh body = make_body(person.mesh.positions, person.mesh.triangles);
    const Rig rig = simple_rig(person);
    DressedBody dressed;
    EXPECT_EQ(find_spikes(rig, body, dressed).edges, 0) << "no body of its own";
    dressed.body = body.surface.positions;
    EXPECT_EQ(find_spikes(rig, body, dressed).edges, 0);
    dressed.body.row(0) += 3 * Eigen::RowVector3d::UnitX();
    const Overstretch spikes = find_spikes(rig, body, dressed);
    EXPECT_GE(spikes.edges, 3);
    EXPECT_GT(spikes.largest, 10);
    EXPECT_FALSE(spikes.part.empty());
}

TEST(Girths, AreTheBodysAndTheGarmentsWhereTheGarmentGoesRound)
{
    const Person person = capsule_person({});
    const Rig rig = rig_body(make_body(person.mesh.positions, person.mesh.triangles));
    constexpr double k_ease = 0.02;
    const TriangleMesh shirt = garment_round(person_skeleton({}), k_ease, [](const Vec3& p) {
        return p.y() > 0.95 && p.y() < 1.45 && std::abs(p.x()) < 0.4;
    });
    const auto measured
        = girths(rig.skeleton, rig.weights, person.mesh, { { shirt.positions, shirt.triangles }, shirt.positions, {} });
    std::vector<std::string> places;
    for (const Girth& girth : measured) {
        places.push_back(girth.place);
        EXPECT_NEAR(girth.ease(), 2 * M_PI * k_ease, 0.04) << girth.place;
    }
    EXPECT_EQ(places, (std::vector<std::string> { "chest", "waist", "left upper arm", "right upper arm" }));
}

}  // namespace
