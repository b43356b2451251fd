// SPDX-License-Identifier: GPL-3.0-or-later
#include "garment_openings.h"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "fixtures.h"
#include "outward_cloth.h"

namespace {

using namespace garmentfit;

constexpr double k_radius = 0.08, k_length = 0.5;  // m

/// An open tube along the y axis, its rows closer together than slices are wide.
TriangleMesh tube()
{
    constexpr int around = 48, rows = 201;
    TriangleMesh mesh { Positions(around * rows, 3), Triangles(2 * around * (rows - 1), 3) };
    for (int i = 0; i < rows; ++i)
        for (int k = 0; k < around; ++k) {
            const double angle = 2 * std::numbers::pi * k / around;
            const int here = i * around + k, next = i * around + (k + 1) % around;
            mesh.positions.row(here) << k_radius * std::sin(angle), k_length * i / (rows - 1),
                k_radius * std::cos(angle);
            if (i + 1 < rows) {
                mesh.triangles.row(2 * here) << here, next, here + around;
                mesh.triangles.row(2 * here + 1) << next, next + around, here + around;
            }
        }
    return outward_cloth(make_garment(mesh.positions, mesh.triangles));
}

/// Part of the tube, open at its sides, from one angle to another; the radius is larger by `out`.
TriangleMesh panel(double from, double to, double low, double high, int columns, int rows, double out = 0)
{
    TriangleMesh mesh { Positions(columns * rows, 3), Triangles(2 * (columns - 1) * (rows - 1), 3) };
    for (int i = 0, f = 0; i < rows; ++i)
        for (int k = 0; k < columns; ++k) {
            const double angle = from + (to - from) * k / (columns - 1);
            const int here = i * columns + k;
            mesh.positions.row(here) << (k_radius + out) * std::sin(angle), low + (high - low) * i / (rows - 1),
                (k_radius + out) * std::cos(angle);
            if (i + 1 < rows && k + 1 < columns) {
                mesh.triangles.row(f++) << here, here + 1, here + columns;
                mesh.triangles.row(f++) << here + 1, here + 1 + columns, here + columns;
            }
        }
    return mesh;
}

std::vector<Opening> openings_of_cloth(const TriangleMesh& mesh)
{
    return openings_of(outward_cloth(make_garment(mesh.positions, mesh.triangles)));
}

TriangleMesh ball()
{
    return fixtures::polygonise([](const Vec3& p) { return p.norm() - 0.3; }, Vec3::Constant(-0.5), Vec3::Constant(0.5),
                                0.1);
}

TEST(GarmentOpenings, OfATubeAreItsTwoEndsWithTheTubeBetween)
{
    const Vec3 axis = Vec3::UnitY();
    const std::vector<Opening> openings = openings_of(tube());
    ASSERT_EQ(openings.size(), 2u);
    for (const Opening& opening : openings) {
        EXPECT_NEAR(opening.girth, 2 * std::numbers::pi * k_radius, 0.01);
        EXPECT_NEAR(opening.tube_girth, opening.girth, 0.1 * opening.girth);
        EXPECT_NEAR(opening.tube_length, k_length, 0.1 * k_length);
        EXPECT_NEAR(std::abs(opening.facing.dot(axis)), 1, 1e-3);
    }
    const Vec3 apart = openings[1].centre - openings[0].centre;
    EXPECT_NEAR(apart.norm(), k_length, 1e-6);
    EXPECT_GT(openings[1].facing.dot(apart), 0);  // outwards
    EXPECT_LT(openings[0].facing.dot(apart), 0);
    EXPECT_TRUE(face_alike(openings[0], openings[1], axis));
}

TEST(GarmentOpenings, OfPanelsWithoutCommonVerticesAreThoseOfTheSewnGarment)
{
    // two halves with other vertices on either side of seams 0.4 mm wide
    constexpr double pi = std::numbers::pi, gap = 0.0002 / k_radius;
    const TriangleMesh front = panel(gap - pi / 2, pi / 2 - gap, 0, k_length, 25, 101),
                       back = panel(pi / 2 + gap, 3 * pi / 2 - gap, 0, k_length, 21, 84);
    const std::vector<Opening> openings = openings_of_cloth(fixtures::joined(front, back));
    ASSERT_EQ(openings.size(), 2u);
    for (const Opening& opening : openings) {
        EXPECT_NEAR(opening.girth, 2 * pi * k_radius, 0.01);
        EXPECT_NEAR(opening.tube_length, k_length, 0.1 * k_length);
        EXPECT_NEAR(opening.piece_height, k_length, 1e-6);
    }
}

/// With its second sheet further in.
TriangleMesh thick(const TriangleMesh& panel, double thickness)
{
    Positions inwards = -thickness / k_radius * panel.positions;
    inwards.col(1).setZero();
    return fixtures::thickened(panel, inwards);
}

TEST(GarmentOpenings, OfPanelsWithThicknessAreThoseOfTheSewnGarment)
{
    // two halves, each closed, their sheets 3 mm and their seams 1 mm apart
    constexpr double pi = std::numbers::pi, gap = 0.0005 / k_radius, thickness = 0.003;
    const TriangleMesh front = panel(gap - pi / 2, pi / 2 - gap, 0, k_length, 25, 101),
                       back = panel(pi / 2 + gap, 3 * pi / 2 - gap, 0, k_length, 21, 84);
    const std::vector<Opening> openings
        = openings_of_cloth(fixtures::joined(thick(front, thickness), thick(back, thickness)));
    ASSERT_EQ(openings.size(), 2u);
    for (const Opening& opening : openings) {
        EXPECT_NEAR(opening.girth, 2 * pi * k_radius, 0.1 * 2 * pi * k_radius);
        EXPECT_NEAR(std::abs(opening.facing.y()), 1, 0.01);
    }
}

TEST(GarmentOpenings, OfManyStripsAreThoseOfTheWhole)
{
    constexpr int strips = 24;
    constexpr double pi = std::numbers::pi, width = 2 * pi / strips, gap = 0.003 / k_radius;
    TriangleMesh all = panel(gap, width, 0, k_length, 4, 60);
    for (int i = 1; i < strips; ++i)
        all = fixtures::joined(all, panel(i * width + gap, (i + 1) * width, 0, k_length, 4, 60));
    const std::vector<Opening> openings = openings_of_cloth(all);
    ASSERT_EQ(openings.size(), 2u);
    for (const Opening& opening : openings)
        EXPECT_NEAR(opening.girth, 2 * pi * k_radius, 0.1 * 2 * pi * k_radius);
}

TEST(GarmentOpenings, PocketsAndFlapsHaveNone)
{
    const TriangleMesh pocket = panel(-0.7, 0.7, 0.2, 0.3, 9, 9, 0.004),
                       far = panel(-0.7, 0.7, 0.2, 0.3, 9, 9, 0.04);  // no part of the garment
    EXPECT_EQ(openings_of_cloth(fixtures::joined(tube(), pocket)).size(), 2u);
    EXPECT_EQ(openings_of_cloth(fixtures::joined(tube(), far)).size(), 3u);
}

TEST(GarmentOpenings, SlitsThatAreTooNarrowForAHandAreNone)
{
    TriangleMesh slit = tube();  // without the faces at an edge of some 10 mm, a hole with a border of 50 mm
    slit.triangles = slit.triangles.topRows(slit.triangles.rows() / 2).eval();
    const std::size_t whole = openings_of_cloth(slit).size();
    Triangles kept(slit.triangles.rows() - 6, 3);
    const Eigen::Index middle = slit.triangles.rows() / 2;
    kept << slit.triangles.topRows(middle), slit.triangles.bottomRows(slit.triangles.rows() - middle - 6);
    slit.triangles = kept;
    EXPECT_EQ(openings_of_cloth(slit).size(), whole);
}

/// A tube round the y axis without those pairs of faces whose middle lies in a window in front, m wide and m high.
TriangleMesh tube_with_window(double radius, double length, double wide, double high, double middle)
{
    constexpr int columns = 161;
    const int rows = int(length / 0.005) + 1;
    constexpr double pi = std::numbers::pi;
    TriangleMesh mesh = panel(-pi, pi, 0, length, columns, rows, radius - k_radius);
    std::vector<Eigen::Index> kept;
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
        const Vec3 at = 0.5
            * (mesh.positions.row(mesh.triangles(f - f % 2, 1)) + mesh.positions.row(mesh.triangles(f - f % 2, 2)))
                  .transpose();
        if (at.z() < 0 || std::abs(at.x()) > wide / 2 || std::abs(at.y() - middle) > high / 2)
            kept.push_back(f);
    }
    mesh.triangles = mesh.triangles(kept, Eigen::all).eval();
    return mesh;
}

TEST(GarmentOpenings, HolesInTheSideOfATubeAreNone)
{
    // 14 cm around: more than a slit that no hand passes, less than an armhole; then one of 55 cm, 2 cm wide
    EXPECT_EQ(openings_of_cloth(tube_with_window(0.15, 0.7, 0.036, 0.036, 0.3)).size(), 2u);
    const TriangleMesh slit = tube_with_window(0.15, 0.7, 0.02, 0.25, 0.15);
    EXPECT_EQ(openings_of_cloth(slit).size(), 2u);
    EXPECT_EQ(count_openings(outward_cloth(make_garment(slit.positions, slit.triangles))), 2u);
}

TEST(GarmentOpenings, ASlitInTheShapeOfAVIsNone)
{
    TriangleMesh mesh = tube_with_window(0.15, 0.7, 0, 0, 0);
    std::vector<Eigen::Index> kept;
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
        const Vec3 at = mesh.positions(mesh.triangles.row(f), Eigen::all).colwise().mean().transpose();
        const double above = at.y() - 0.3;  // m, the tip
        const bool is_in_slit
            = at.z() > 0 && above > 0 && above < 0.06 && std::abs(std::abs(at.x()) - 0.5 * above) < 0.005;
        if (!is_in_slit)
            kept.push_back(f);
    }
    mesh.triangles = mesh.triangles(kept, Eigen::all).eval();
    EXPECT_EQ(openings_of_cloth(mesh).size(), 2u);
}

TEST(GarmentOpenings, ANeckThatGoesOnInAPlacketIsNoSlit)
{
    EXPECT_EQ(openings_of_cloth(tube_with_window(0.15, 0.7, 0.13, 0.6, 0.35)).size(), 3u);
}

/// A tube of a few rows of faces along the y axis, whose radii are given from row to row.
std::vector<Opening> openings_of_coarse_tube(const std::vector<std::pair<double, double>>& heights_and_radii)
{
    constexpr int around = 48;
    TriangleMesh mesh = panel(-std::numbers::pi, std::numbers::pi, 0, 1, around + 1, int(heights_and_radii.size()));
    for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v) {
        const auto [height, radius] = heights_and_radii[std::size_t(v / (around + 1))];
        mesh.positions.row(v) *= radius / k_radius;
        mesh.positions(v, 1) = height;
    }
    return openings_of_cloth(mesh);
}

TEST(GarmentOpenings, FacesLongerThanASliceLeaveNoGapsInATube)
{
    const std::vector<Opening> openings
        = openings_of_coarse_tube({ { 0, 0.1 }, { 0.17, 0.1 }, { 0.34, 0.1 }, { 0.5, 0.1 } });
    ASSERT_EQ(openings.size(), 2u);
    for (const Opening& opening : openings) {
        EXPECT_GT(opening.tube_length, 0.4);
        EXPECT_NEAR(opening.tube_girth, 2 * std::numbers::pi * 0.1, 0.03);
        EXPECT_NEAR(opening.tube_waist, opening.tube_girth, 0.1 * opening.tube_girth);
    }
}

TEST(GarmentOpenings, ATubeGoesOnBehindACuffThatIsHalfAsWide)
{
    std::vector<std::pair<double, double>> rows;
    for (int i = 0; i <= 50; ++i)
        rows.emplace_back(0.01 * i, i < 3 ? 0.019 : 0.035);
    const std::vector<Opening> openings = openings_of_coarse_tube(rows);
    ASSERT_EQ(openings.size(), 2u);
    for (const Opening& opening : openings)
        EXPECT_GT(opening.tube_length, 0.4);
}

TEST(GarmentOpenings, ArmholesWithoutATubeAndNarrowCuffsStay)
{
    EXPECT_EQ(openings_of_cloth(tube_with_window(0.15, 0.7, 0.12, 0.14, 0.4)).size(), 3u);  // 50 cm around
    const std::vector<Opening> sleeve = openings_of_cloth(tube_with_window(0.021, 0.7, 0, 0, 0));
    ASSERT_EQ(sleeve.size(), 2u);
    EXPECT_LT(sleeve[0].girth, 0.2 * 0.7);  // as narrow as the hole above
}

TEST(GarmentOpenings, RotateWithTheirGarment)
{
    const TriangleMesh cloth = tube();
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(1, Vec3(1, 2, 3).normalized()));
    const TriangleMesh rotated = rotate(cloth, turn);
    const std::vector<Opening> expected = openings_of(rotated), result = rotate(openings_of(cloth), rotated, turn);
    ASSERT_EQ(result.size(), expected.size());
    for (std::size_t i = 0; i < result.size(); ++i) {
        EXPECT_LT((result[i].centre - expected[i].centre).norm(), 1e-9);
        EXPECT_LT((result[i].facing - expected[i].facing).norm(), 1e-9);
        EXPECT_LT((result[i].low - expected[i].low).norm(), 1e-9);
        EXPECT_NEAR(result[i].piece_height, expected[i].piece_height, 1e-9);
    }
}

TEST(GarmentOpenings, ABallHasNoneAndIsSealed)
{
    EXPECT_TRUE(openings_of(ball()).empty());
    EXPECT_TRUE(is_sealed(ball()));
    EXPECT_FALSE(is_sealed(tube()));
}

TEST(GarmentOpenings, PiecesAreCounted)
{
    TriangleMesh far = ball();
    far.positions.array() += 2;
    const Pieces pieces = count_pieces(fixtures::joined(tube(), far));
    EXPECT_EQ(pieces.count, 2);
    EXPECT_NEAR(pieces.largest, 0.6, 0.05);
}

}  // namespace
