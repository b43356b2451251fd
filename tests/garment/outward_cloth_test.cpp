// SPDX-License-Identifier: GPL-3.0-or-later
#include "outward_cloth.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "cloth_patches.h"
#include "fixtures.h"
#include "plain_reading.h"
#include "surface_measures.h"
#include "topology.h"

namespace {

using namespace garmentfit;

TriangleMesh ball(double radius)
{
    return fixtures::polygonise([&](const Vec3& p) { return p.norm() - radius; }, Vec3::Constant(-0.5),
                                Vec3::Constant(0.5), 0.05);
}

constexpr int k_around = 60, k_rows = 21;

/// A closed surface: two tubes about the y axis, `thickness` apart, joined at both ends. The topology of a torus.
TriangleMesh thick_tube(double radius, double height, double thickness)
{
    constexpr int rings = 2 * k_rows;  // up the outer sheet and down the inner one
    TriangleMesh mesh { Positions(k_around * rings, 3), Triangles(2 * k_around * rings, 3) };
    for (int i = 0; i < rings; ++i)
        for (int k = 0; k < k_around; ++k) {
            const bool outer = i < k_rows;
            const double r = radius + (outer ? 0.5 : -0.5) * thickness, angle = 2 * std::numbers::pi * k / k_around;
            const double y = height * (outer ? i : rings - 1 - i) / (k_rows - 1);
            const int here = i * k_around + k, next = i * k_around + (k + 1) % k_around;
            const int above = (here + k_around) % (k_around * rings), beside = (next + k_around) % (k_around * rings);
            mesh.positions.row(here) << r * std::sin(angle), y, r * std::cos(angle);
            mesh.triangles.row(2 * here) << here, next, above;
            mesh.triangles.row(2 * here + 1) << next, beside, above;
        }
    return mesh;
}

/// Pleats, whose inner sheet is turned by a fifth of one, so that the sheets pass through each other at every crease.
TriangleMesh pleated_tube()
{
    TriangleMesh mesh = thick_tube(0.2, 0.6, 0.008);
    constexpr int rings = 2 * k_rows;
    for (int i = 0; i < rings; ++i)
        for (int k = 0; k < k_around; ++k) {
            const bool outer = i < k_rows;
            const double r = 0.2 + (k % 2 ? 0.02 : -0.02) + (outer ? 0.5 : -0.5) * 0.004,
                         angle = 2 * std::numbers::pi * (k + (outer ? 0 : 0.2)) / k_around;
            mesh.positions(i * k_around + k, 0) = r * std::sin(angle);
            mesh.positions(i * k_around + k, 2) = r * std::cos(angle);
        }
    return mesh;
}

GarmentMesh garment_of(const TriangleMesh& mesh) { return make_garment(mesh.positions, mesh.triangles); }

TEST(OutwardCloth, FacesInAnyOrientationAreTurnedOutwards)
{
    const TriangleMesh sphere = ball(0.3);
    TriangleMesh mixed = sphere;
    for (Eigen::Index f = 0; f < mixed.triangles.rows(); f += 3)
        std::swap(mixed.triangles(f, 1), mixed.triangles(f, 2));
    const TriangleMesh cloth = outward_cloth(garment_of(mixed));
    EXPECT_EQ(cloth.triangles.rows(), sphere.triangles.rows());
    EXPECT_NEAR(volume(cloth), volume(sphere), 1e-9);
}

TEST(OutwardCloth, EqualVerticesAndFacesAreMerged)
{
    const TriangleMesh sphere = ball(0.3);
    const TriangleMesh cloth = outward_cloth(garment_of(fixtures::joined(sphere, sphere)));
    EXPECT_EQ(cloth.positions.rows(), sphere.positions.rows());
    EXPECT_EQ(cloth.triangles.rows(), sphere.triangles.rows());
}

/// An open tube about the y axis, from its lower rim up.
TriangleMesh open_tube(double radius, double from, double to, int rows)
{
    TriangleMesh mesh { Positions(k_around * rows, 3), Triangles(2 * k_around * (rows - 1), 3) };
    for (int i = 0; i < rows; ++i)
        for (int k = 0; k < k_around; ++k) {
            const double angle = 2 * std::numbers::pi * k / k_around;
            const int here = i * k_around + k, next = i * k_around + (k + 1) % k_around;
            mesh.positions.row(here) << radius * std::sin(angle), from + (to - from) * i / (rows - 1),
                radius * std::cos(angle);
            if (i + 1 == rows)
                continue;
            mesh.triangles.row(2 * here) << here, next, here + k_around;
            mesh.triangles.row(2 * here + 1) << next, next + k_around, here + k_around;
        }
    return mesh;
}

// A sleeve with a cuff of two sheets, which are joined where it begins.
TEST(PlainReading, OfACuffOfTwoSheetsServesNot)
{
    const TriangleMesh sleeve = open_tube(0.06, 0, 0.5, k_rows);
    EXPECT_TRUE(read_plainly(garment_of(sleeve)).serves);
    TriangleMesh cuffed = sleeve;
    for (const double radius : { 0.061, 0.064 }) {
        TriangleMesh sheet = open_tube(radius, -0.03, 0, 3);
        sheet.positions.bottomRows(k_around) = sleeve.positions.topRows(k_around);
        cuffed = fixtures::joined(cuffed, sheet);
    }
    EXPECT_FALSE(read_plainly(garment_of(cuffed)).serves);
}

// Two sheets that are joined at the upper end only.
TEST(PlainReading, OfTwoSheetsThatAreNotJoinedAtTheHemServesNot)
{
    TriangleMesh sheets = thick_tube(0.15, 0.6, 0.004);
    sheets.triangles.conservativeResize(sheets.triangles.rows() - 2 * k_around, 3);
    EXPECT_FALSE(read_plainly(garment_of(sheets)).serves);
}

// A tube of 38 cm, 6 mm open along its whole length, and a square ring of 3 cm over the middle of the gap.
TEST(PlainReading, JoinsWhatOnlyARingHoldsTogether)
{
    const auto on_tube = [](const TriangleMesh& sheet, double radius, double from) {
        TriangleMesh bent = sheet;
        for (auto row : bent.positions.rowwise()) {
            const double angle = from + row.x() / 0.0615;
            row << radius * std::cos(angle), radius * std::sin(angle), Vec3(row.transpose()).z();
        }
        return bent;
    };
    const TriangleMesh tube = on_tube(fixtures::flat(20, 0.02, Vec3::Zero()), 0.0615, 0.04);
    TriangleMesh ring = fixtures::flat(4, 0.01, Vec3(-0.015, 0, 0.175));
    std::vector<Eigen::Index> kept;
    for (Eigen::Index f = 0; f < ring.triangles.rows(); ++f)
        if (const Vec3 middle = ring.positions(ring.triangles.row(f), Eigen::all).colwise().mean().transpose();
            std::max(std::abs(middle.x()), std::abs(middle.z() - 0.19)) > 0.005)
            kept.push_back(f);
    ring = on_tube({ ring.positions, ring.triangles(kept, Eigen::all) }, 0.0645, 0);
    const auto borders = [](const TriangleMesh& mesh) {
        const TriangleMesh cloth = read_plainly(make_garment(mesh.positions, mesh.triangles)).cloth;
        return MeshTopology(cloth.triangles, int(cloth.positions.rows())).border_loops().size();
    };
    EXPECT_EQ(borders(tube), 1u);
    EXPECT_EQ(borders(fixtures::joined(tube, ring)), 2u + 2u) << "the ring has two of its own";
}

TEST(OutwardCloth, OfThickClothTheOuterSheetIsTheSameInAnyUnit)
{
    const TriangleMesh thick = thick_tube(0.25, 0.4, 0.015);
    const Triangles outer = outward_cloth(garment_of(thick)).triangles;
    for (const double unit : { 0.1, 10.0 }) {
        const Triangles scaled = outward_cloth(garment_of({ unit * thick.positions, thick.triangles })).triangles;
        ASSERT_EQ(scaled.rows(), outer.rows()) << unit;
        EXPECT_EQ(scaled, outer) << unit;
    }
}

TEST(OutwardCloth, OfManyVerticesIsReadOnce)
{
    constexpr double k_unit = 100;
    const TriangleMesh ball = fixtures::polygonise([](const Vec3& p) { return p.norm() - 0.3; }, Vec3::Constant(-0.4),
                                                   Vec3::Constant(0.4), 0.004);
    ASSERT_GT(ball.positions.rows(), 20000);
    const TriangleMesh first = outward_cloth(garment_of(ball)),
                       scaled = outward_cloth(garment_of({ k_unit * ball.positions, ball.triangles }));
    EXPECT_EQ(scaled.triangles, first.triangles);
    EXPECT_LT((scaled.positions - k_unit * first.positions).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(OutwardCloth, OfThickClothTheOuterSheetRemains)
{
    constexpr double radius = 0.25, thickness = 0.004;
    const TriangleMesh thick = thick_tube(radius, 0.4, thickness);
    const TriangleMesh cloth = outward_cloth(garment_of(thick));
    EXPECT_LT(area(cloth), 0.6 * area(thick));
    double inner = 0;
    for (Eigen::Index f = 0; f < cloth.triangles.rows(); ++f) {
        const Vec3 middle = cloth.positions(cloth.triangles.row(f), Eigen::all).colwise().mean();
        if (std::hypot(middle.x(), middle.z()) < radius - 0.25 * thickness)
            inner += area_vector(cloth.positions, cloth.triangles, f).norm();
    }
    EXPECT_LT(inner, 0.05 * area(cloth));
}

TEST(OutwardCloth, OfCoarseClothWhoseSheetsPassThroughEachOtherOneRemains)
{
    const TriangleMesh skirt = pleated_tube(), cloth = outward_cloth(garment_of(skirt));
    EXPECT_NEAR(double(cloth.triangles.rows()), 0.5 * double(skirt.triangles.rows()), 2 * k_around);  // the rims
    const double rim = border_length(cloth.positions, MeshTopology(cloth.triangles, int(cloth.positions.rows())));
    EXPECT_LT(rim, 2 * 1.5 * k_around * 0.05);  // m, twice round its pleats: a side of them is 0.045 long
}

/// A band about the y axis, wound up with a gap between its turns.
TriangleMesh wound_band()
{
    constexpr double turns = 1.6;
    TriangleMesh mesh = fixtures::sheet(161, 1. / 160, [](double, double) { return 0; });
    for (auto row : mesh.positions.rowwise()) {
        const double angle = 2 * std::numbers::pi * turns * row.x(), up = 0.1 * turns * row.x() + 0.08 * row.z();
        row << 0.15 * std::sin(angle), up, 0.15 * std::cos(angle);
    }
    return mesh;
}

// Of sheets that pass through each other, such bands may be left of the outer one.
TEST(PlainReading, WithABorderThatRunsToAndFroServesNot)
{
    const TriangleMesh tube = open_tube(0.15, 0.3, 0.4, k_rows);
    EXPECT_TRUE(read_plainly(garment_of(tube)).serves);
    EXPECT_FALSE(read_plainly(garment_of(fixtures::joined(wound_band(), tube))).serves);
}

}  // namespace
