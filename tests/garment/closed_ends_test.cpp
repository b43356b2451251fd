// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/closed_ends.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "fixtures.h"
#include "topology.h"
#include "used_vertices.h"

namespace garmentfit {
namespace {

constexpr int k_around = 24, k_rows = 11;

/// A tube along y, with caps at its lower and upper end: none, a fan around a vertex, or a fan around a corner.
enum class Cap { none, around_centre, around_corner };

TriangleMesh tube(Cap lower, Cap upper, double x = 0, int around = k_around)
{
    TriangleMesh mesh { Positions(around * k_rows + 2, 3), Triangles(4 * around * k_rows, 3) };
    int f = 0;
    for (int i = 0; i < k_rows; ++i)
        for (int k = 0; k < around; ++k) {
            const double angle = 2 * std::numbers::pi * k / around;
            const int here = i * around + k, next = i * around + (k + 1) % around;
            mesh.positions.row(here) << x + 0.1 * std::sin(angle), 0.05 * i, 0.1 * std::cos(angle);
            if (i + 1 < k_rows) {
                mesh.triangles.row(f++) << here, next, here + around;
                mesh.triangles.row(f++) << next, next + around, here + around;
            }
        }
    for (const auto& [cap, row] : { std::pair { lower, 0 }, std::pair { upper, k_rows - 1 } }) {
        const int first = row * around, centre = around * k_rows + (row > 0);
        mesh.positions.row(centre) << x, 0.05 * row, 0;
        for (int k = 0; k < around && cap == Cap::around_centre; ++k)
            mesh.triangles.row(f++) << centre, first + (k + 1) % around, first + k;
        for (int k = 1; k + 1 < around && cap == Cap::around_corner; ++k)
            mesh.triangles.row(f++) << first, first + k + 1, first + k;
    }
    mesh.triangles.conservativeResize(f, 3);
    return mesh;
}

/// A tube whose rims rise and fall by `wave`, as hems do; filled from rim to rim in a zigzag, or not.
TriangleMesh tube_with_wavy_ends(double wave, bool is_filled, double x = 0)
{
    TriangleMesh mesh = tube(Cap::none, Cap::none, x);
    for (const int first : { 0, (k_rows - 1) * k_around }) {
        for (int k = 0; k < k_around; ++k)
            mesh.positions(first + k, 1) += wave * std::sin(4 * std::numbers::pi * k / k_around);
        for (int low = 0, high = k_around - 1; is_filled && low + 1 < high;) {
            const Eigen::Index f = mesh.triangles.rows();
            mesh.triangles.conservativeResize(f + 1, 3);
            const bool is_low = low <= k_around - 1 - high;
            mesh.triangles.row(f) << first + low, first + (is_low ? low + 1 : high - 1), first + high;
            is_low ? ++low : --high;
        }
    }
    return mesh;
}

TriangleMesh pair_of_tubes(double wave, bool is_filled)
{
    return fixtures::joined(tube_with_wavy_ends(wave, is_filled, -0.15), tube_with_wavy_ends(wave, is_filled, 0.15));
}

OpenedGarment opened(const TriangleMesh& mesh) { return open_ends({ mesh.positions, mesh.triangles }); }

TEST(ClosedEnds, AreOpenedHoweverTheirHolesWereFilled)
{
    const TriangleMesh open = tube(Cap::none, Cap::none);
    for (const Cap cap : { Cap::around_centre, Cap::around_corner })
        for (const bool is_lower : { true, false }) {
            const TriangleMesh capped = is_lower ? tube(cap, Cap::none) : tube(Cap::none, cap);
            const OpenedGarment result = opened(capped);
            EXPECT_EQ(result.closed_ends, 1);
            EXPECT_EQ(result.garment.triangles, open.triangles);
            EXPECT_EQ(result.garment.positions, capped.positions);
        }
}

TEST(ClosedEnds, AreOpenedWhereAFanIsSunkIntoTheTube)
{
    const TriangleMesh open = tube(Cap::none, Cap::none, 0, 12);
    for (const double depth : { 0.03, 0.1, 0.18 }) {
        TriangleMesh capped = tube(Cap::none, Cap::around_centre, 0, 12);
        const Eigen::Index centre = 12 * k_rows + 1;
        capped.positions(centre, 1) -= depth;
        EXPECT_EQ(opened(capped).garment.triangles, open.triangles) << depth;
        capped.positions(centre, 1) += 2 * depth;  // the tip of a hood, say
        EXPECT_EQ(opened(capped).closed_ends, 0) << depth;
    }
}

TEST(ClosedEnds, AStarOfTrianglesInTheClothIsNone)
{
    // a sheet with a star of twelve triangles in a pit, around which the cloth goes on to all sides
    constexpr int around = 12, rings = 6;
    TriangleMesh sheet { Positions(around * rings + 1, 3), Triangles(around * (2 * rings - 1), 3) };
    int f = 0;
    sheet.positions.row(0) << 0, -0.03, 0;
    for (int i = 0; i < rings; ++i)
        for (int k = 0; k < around; ++k) {
            const double angle = 2 * std::numbers::pi * k / around, radius = 0.1 * (i + 1);
            const int here = 1 + i * around + k, next = 1 + i * around + (k + 1) % around;
            sheet.positions.row(here) << radius * std::cos(angle), 0, radius * std::sin(angle);
            if (i == 0)
                sheet.triangles.row(f++) << 0, here, next;
            else
                sheet.triangles.row(f++) << here - around, here, next;
            if (i > 0)
                sheet.triangles.row(f++) << here - around, next, next - around;
        }
    EXPECT_EQ(opened(sheet).closed_ends, 0);
}

TEST(ClosedEnds, OfAnOpenGarmentAreNone)
{
    const TriangleMesh open = tube(Cap::none, Cap::none);
    EXPECT_EQ(opened(open).closed_ends, 0);
    EXPECT_EQ(opened(open).garment.triangles, open.triangles);
}

/// A skirt in box pleats, each of which has one facet in front, from waist to hem.
TriangleMesh pleated_skirt()
{
    constexpr int pleats = 6;
    const double height = 0.5, front = 0.045, inner = 0.13, outer = 0.15;
    TriangleMesh skirt { Positions(8 * pleats, 3), Triangles(8 * pleats, 3) };
    for (int k = 0; k < 4 * pleats; ++k) {
        const double angle = 2 * std::numbers::pi * (k / 4) / pleats, radius = k % 4 == 0 || k % 4 == 3 ? inner : outer,
                     across = k % 4 < 2 ? -front / 2 : front / 2;
        const double x = radius * std::cos(angle) - across * std::sin(angle),
                     z = radius * std::sin(angle) + across * std::cos(angle);
        const int next = (k + 1) % (4 * pleats), above = 4 * pleats;
        skirt.positions.row(k) << x, 0, z;
        skirt.positions.row(k + above) << x, height, z;
        skirt.triangles.row(2 * k) << k, k + above, next;
        skirt.triangles.row(2 * k + 1) << next, k + above, next + above;
    }
    return skirt;
}

TEST(ClosedEnds, TrianglesThatAFileRepeatsCountOnce)
{
    const TriangleMesh once = tube(Cap::none, Cap::none);
    const Eigen::Index n = once.triangles.rows();
    GarmentMesh thrice { once.positions, Triangles(3 * n, 3) };
    thrice.triangles << once.triangles, once.triangles(Eigen::all, std::array { 1, 2, 0 }), once.triangles;
    EXPECT_EQ(open_ends(thrice).garment.triangles, once.triangles);
}

TEST(ClosedEnds, TrianglesKeepTheirWarpWhenEndsAreOpened)
{
    const TriangleMesh closed = tube(Cap::around_centre, Cap::none);
    GarmentMesh garment { closed.positions, closed.triangles, Warps::Zero(closed.triangles.rows(), 2) };
    for (Eigen::Index f = 0; f < garment.warps.rows(); ++f)  // numbers, to be known again
        garment.warps(f, 0) = double(f);
    const GarmentMesh opened = open_ends(garment).garment;
    ASSERT_LT(opened.triangles.rows(), garment.triangles.rows());
    ASSERT_EQ(opened.warps.rows(), opened.triangles.rows());
    for (Eigen::Index f = 0; f < opened.triangles.rows(); ++f)
        EXPECT_EQ(garment.triangles.row(Eigen::Index(opened.warps(f, 0))), opened.triangles.row(f));
}

TEST(ClosedEnds, TrianglesThatAFileRepeatsWithVerticesOfTheirOwnCountOnce)
{
    const TriangleMesh once = tube(Cap::none, Cap::none), twice = fixtures::joined(once, once);
    const GarmentMesh garment { twice.positions, twice.triangles };
    EXPECT_EQ(open_ends(garment).garment.triangles, once.triangles);
    EXPECT_EQ(without_scenery(garment), once.triangles);
}

// As cloth of its own it would make the garment twice as stiff.
TEST(ClosedEnds, TheOtherSideOfATriangleIsARepetition)
{
    const TriangleMesh once = tube(Cap::none, Cap::none);
    const Eigen::Index n = once.triangles.rows();
    GarmentMesh both_sides { once.positions, Triangles(2 * n, 3) };
    both_sides.triangles << once.triangles, once.triangles(Eigen::all, std::array { 0, 2, 1 });
    EXPECT_EQ(open_ends(both_sides).garment.triangles, once.triangles);
    EXPECT_EQ(without_scenery(both_sides), once.triangles);
}

TEST(ClosedEnds, PleatsFromWaistToHemAreNone)
{
    const TriangleMesh skirt = pleated_skirt();
    const OpenedGarment result = opened(skirt);
    EXPECT_EQ(result.closed_ends, 0);
    EXPECT_EQ(result.garment.triangles, skirt.triangles);
}

TriangleMesh shorts(const Vec3& offset, double scale)
{
    const Skeleton skeleton = fixtures::person_skeleton({});
    const double waist = skeleton.root.y() + 0.1;
    TriangleMesh mesh = fixtures::garment_round(
        skeleton, 0.02, [&](const Vec3& p) { return p.y() < waist && p.y() > waist - 0.45 && std::abs(p.x()) < 0.26; },
        0.04);
    const std::vector<int> used = used_vertices(mesh.triangles);
    mesh = { mesh.positions(used, Eigen::all), numbered_among(used, mesh.triangles) };
    mesh.positions = (scale * mesh.positions).rowwise() + offset.transpose();
    return mesh;
}

TEST(ClosedEnds, AGarmentBesideALargerOneIsLeftOut)
{
    const TriangleMesh mine = shorts(Vec3::Zero(), 1), other = shorts(Vec3(0.8, 0.1, 0), 0.9);
    const OpenedGarment result = opened(fixtures::joined(other, mine));
    EXPECT_EQ(result.left_out.garments, 1);
    EXPECT_EQ(result.left_out.faces, other.triangles.rows());
    EXPECT_EQ(result.garment.triangles.rows(), mine.triangles.rows());
    EXPECT_EQ(result.garment.positions.bottomRows(mine.positions.rows()), mine.positions);
    const Positions gathered = result.garment.positions.topRows(other.positions.rows());
    EXPECT_EQ(gathered, gathered.row(0).replicate(gathered.rows(), 1));
}

TEST(ClosedEnds, WhatIsFarLargerThanAGarmentAndApartFromItIsLeftOut)
{
    const TriangleMesh mine = shorts(Vec3::Zero(), 1);
    for (const auto& [below, left_out] : { std::pair(Cap::around_centre, 1), std::pair(Cap::none, 0) }) {
        TriangleMesh plinth = tube(below, Cap::none);  // a bowl, or a skirt
        plinth.positions *= 3;
        plinth.positions.col(1).array() -= 3;
        const TriangleMesh both = fixtures::joined(mine, plinth);
        EXPECT_EQ(opened(both).left_out.backdrops, left_out);
        EXPECT_EQ(without_scenery(make_garment(both.positions, both.triangles)).rows(),
                  both.triangles.rows() - left_out * plinth.triangles.rows());
    }
}

TEST(ClosedEnds, WhatIsNoGarmentBesideALargerOneIsKept)
{
    const TriangleMesh mine = shorts(Vec3::Zero(), 1);
    EXPECT_EQ(opened(fixtures::joined(mine, shorts(Vec3(0, 0.8, 0), 0.9))).left_out.garments, 0) << "above it";
    EXPECT_EQ(opened(fixtures::joined(mine, shorts(Vec3(0.8, 0, 0), 0.3))).left_out.garments, 0) << "a doll's";
    TriangleMesh tall = tube(Cap::none, Cap::none, 0.8);
    tall.positions.col(1).array() += mine.positions.col(1).minCoeff();
    EXPECT_EQ(opened(fixtures::joined(mine, tall)).left_out.garments, 0) << "a sleeve";
    EXPECT_EQ(
        opened(fixtures::joined(tube(Cap::none, Cap::none, -0.3), tube(Cap::none, Cap::none, 0.3))).left_out.garments,
        0)
        << "a pair of socks";
}

TEST(ClosedEnds, OfTwoPiecesAreCountedTogether)
{
    const OpenedGarment result = opened(
        fixtures::joined(tube(Cap::around_centre, Cap::none, -0.15), tube(Cap::around_corner, Cap::none, 0.15)));
    EXPECT_EQ(result.closed_ends, 2);
}

TEST(ClosedEnds, OfAGarmentClosedEverywhereAreOpenedThoughTheyAreNotFlat)
{
    const TriangleMesh open = pair_of_tubes(0.02, false);
    const OpenedGarment result = opened(pair_of_tubes(0.02, true));
    EXPECT_EQ(result.closed_ends, 4);
    EXPECT_LE(result.garment.triangles.rows(), open.triangles.rows() + 2 * 4) << "a zigzag has an ear at either end";
}

TEST(ClosedEnds, OfAGarmentClosedEverywhereAreOpenedWhereAFanFoldsBackAtANeckline)
{
    const auto with_neckline = [](Cap lower, Cap upper, double x) {
        TriangleMesh mesh = tube(lower, upper, x);
        const int first = (k_rows - 1) * k_around, centre = k_rows * k_around + 1;
        for (int v = first; v < first + k_around; ++v)  // lower in front
            mesh.positions(v, 1) -= 0.6 * std::max(0., mesh.positions(v, 2));
        mesh.positions.row(centre) += Eigen::RowVector3d(0, 0.06, 0.06);
        return mesh;
    };
    const auto pair
        = [&](Cap end) { return fixtures::joined(with_neckline(end, end, -0.15), with_neckline(end, end, 0.15)); };
    const OpenedGarment result = opened(pair(Cap::around_centre));
    EXPECT_EQ(result.closed_ends, 4);
    EXPECT_EQ(result.garment.triangles, pair(Cap::none).triangles);
}

TEST(ClosedEnds, OfAClosedPieceAreOpenedThoughALabelBesideItIsOpen)
{
    const TriangleMesh filled = tube_with_wavy_ends(0.02, true);
    TriangleMesh label = tube(Cap::none, Cap::none, 0.3);
    label.positions *= 0.1;
    EXPECT_EQ(opened(fixtures::joined(filled, label)).closed_ends, 2);
    EXPECT_EQ(opened(fixtures::joined(tube_with_wavy_ends(0.02, false), label)).closed_ends, 0);
}

TEST(ClosedEnds, AreNoCoarseFacets)
{
    // on either tube one column and one row are wide: where they meet, a square of two faces is as wide as a cuff
    constexpr double wide = 3.5, shear = 0.1;  // cells
    const auto with_wide_cell = [](double x) {
        TriangleMesh mesh = tube(Cap::around_centre, Cap::around_centre, x);
        const double cell = 2 * std::numbers::pi / (k_around - 1 + wide);  // rad; and radii
        for (int i = 0; i < k_rows; ++i)
            for (int k = 0; k < k_around; ++k) {
                const double up = i + (i > k_rows / 2 ? wide - 1 : 0), angle = cell * (k + shear * up);
                mesh.positions.row(i * k_around + k) << x + 0.1 * std::sin(angle), 0.1 * cell * up,
                    0.1 * std::cos(angle);
            }
        mesh.positions(k_rows * k_around + 1, 1) = mesh.positions(k_rows * k_around - 1, 1);
        return mesh;
    };
    const OpenedGarment result = opened(fixtures::joined(with_wide_cell(-0.15), with_wide_cell(0.15)));
    EXPECT_EQ(result.closed_ends, 4);
}

TEST(ClosedEnds, ThatAreNotFlatAreOpenedThoughAnotherEndIsOpen)
{
    TriangleMesh filled = tube_with_wavy_ends(0.02, true);
    const Eigen::Index faces_of_end = k_around - 2;
    filled.triangles.conservativeResize(filled.triangles.rows() - faces_of_end, 3);
    const OpenedGarment result = opened(filled);
    EXPECT_EQ(result.closed_ends, 1);
    EXPECT_LE(result.garment.triangles.rows(), filled.triangles.rows() - faces_of_end + 2);
}

TEST(ClosedEnds, AreNotTheSidesOfPanelsWithThickness)
{
    constexpr double size = 0.3, thickness = 0.002;
    const TriangleMesh side = fixtures::sheet(10, size / 9, [](double, double) { return 0; });
    const Positions down = Eigen::RowVector3d(0, -thickness, 0).replicate(side.positions.rows(), 1);
    TriangleMesh panels = fixtures::thickened(side, down);
    for (int i = 1; i < 4; ++i) {
        TriangleMesh next = fixtures::thickened(side, down);
        next.positions.col(0).array() += 1.01 * i * size;
        panels = fixtures::joined(panels, next);
    }
    EXPECT_EQ(opened(panels).closed_ends, 0);
    EXPECT_EQ(opened(panels).garment.triangles.rows(), panels.triangles.rows());
}

/// A disc across a tube at a height, round its axis.
TriangleMesh lid(double y, double radius)
{
    TriangleMesh mesh { Positions(k_around, 3), Triangles(k_around - 2, 3) };
    for (int k = 0; k < k_around; ++k) {
        const double angle = 2 * std::numbers::pi * k / k_around;
        mesh.positions.row(k) << radius * std::sin(angle), y, radius * std::cos(angle);
    }
    for (int k = 1; k + 1 < k_around; ++k)
        mesh.triangles.row(k - 1) << 0, k, k + 1;
    return mesh;
}

TEST(ClosedEnds, AreOpenedWhereALidLiesLooselyInThem)
{
    const TriangleMesh open = tube(Cap::none, Cap::none);
    const OpenedGarment result = opened(fixtures::joined(open, lid(0.01, 0.098)));
    EXPECT_EQ(result.closed_ends, 1);
    EXPECT_EQ(result.garment.triangles, open.triangles);
}

TEST(ClosedEnds, AreOpenedWhereALidIsAsCrumpledAsItsCuff)
{
    const auto wavy = [](TriangleMesh disc) {
        for (auto row : disc.positions.rowwise())
            row.y() += 4 * row.x() * row.z();  // a saddle, 0.4 of the radius deep
        return disc;
    };
    const TriangleMesh open = tube_with_wavy_ends(0.02, false);
    EXPECT_EQ(opened(fixtures::joined(open, wavy(lid(0.005, 0.098)))).closed_ends, 1);
}

TEST(ClosedEnds, AreNotDiscsThatLieOnTheClothOrOutsideIt)
{
    const TriangleMesh open = tube(Cap::none, Cap::none), small = lid(0, 0.03);
    TriangleMesh label = small;  // upright, on the cloth
    label.positions.col(1) = small.positions.col(0).array() + 0.25;
    label.positions.col(0).setConstant(0.101);
    for (const TriangleMesh& disc : { label, lid(0.01, 0.05), lid(1, 0.098) })
        EXPECT_EQ(opened(fixtures::joined(open, disc)).closed_ends, 0);
}

TEST(ClosedEnds, OfAClothThatASolidFillsAreOpen)
{
    const TriangleMesh open = tube(Cap::none, Cap::none);
    for (const Cap cap : { Cap::around_centre, Cap::around_corner }) {
        TriangleMesh solid = tube(cap, cap, 0, 8);
        solid.positions *= 0.9;
        const OpenedGarment result = opened(fixtures::joined(open, solid));
        EXPECT_EQ(result.closed_ends, 0);
        EXPECT_EQ(result.garment.triangles, open.triangles);
        EXPECT_EQ(result.left_out.solids, 1);
        EXPECT_EQ(result.left_out.lids, 0);
        EXPECT_EQ(result.left_out.faces, solid.triangles.rows());
    }
}

TEST(ClosedEnds, OfSolidsInEachOtherTheOutermostIsTheCloth)
{
    const auto ball = [](double radius) {
        return fixtures::polygonise([&](const Vec3& p) { return p.norm() - radius; }, Vec3::Constant(-0.5),
                                    Vec3::Constant(0.5), 0.05);
    };
    const TriangleMesh outer = ball(0.4);
    const OpenedGarment result = opened(fixtures::joined(ball(0.35), outer));
    EXPECT_EQ(result.left_out.solids, 1);
    EXPECT_EQ(result.garment.triangles.rows(), outer.triangles.rows());
}

TEST(ClosedEnds, SpecksFarFromTheClothAreLeftOut)
{
    const TriangleMesh open = tube(Cap::none, Cap::none);
    TriangleMesh speck = tube(Cap::around_centre, Cap::around_centre, 0, 8);
    speck.positions *= 0.005;
    speck.positions.col(1).array() += 0.5;
    for (const auto& [from_axis, specks] : { std::pair(0.0, 1), std::pair(0.095, 0) }) {  // far from it, and on it
        TriangleMesh placed = speck;
        placed.positions.col(0).array() += from_axis;
        const OpenedGarment result = opened(fixtures::joined(open, placed));
        EXPECT_EQ(result.left_out.specks, specks);
        EXPECT_EQ(result.left_out.faces, specks * speck.triangles.rows());
        const TriangleMesh both = fixtures::joined(open, placed);
        EXPECT_EQ(without_scenery(make_garment(both.positions, both.triangles)).rows(),
                  both.triangles.rows() - specks * speck.triangles.rows());
    }
}

// Below a collar in one piece. Each face has corners of its own.
TEST(ClosedEnds, ClothOfSingleFacesIsNoSpecks)
{
    const TriangleMesh open = tube(Cap::none, Cap::none);
    TriangleMesh collar = open, apart = open;
    collar.positions *= 0.5;
    collar.positions.col(1).array() += 3;
    apart.positions = open.positions(open.triangles.transpose().reshaped(), Eigen::all);
    for (Eigen::Index f = 0; f < open.triangles.rows(); ++f) {
        apart.triangles.row(f) << int(3 * f), int(3 * f + 1), int(3 * f + 2);
        apart.positions.middleRows(3 * f, 3).rowwise() += Eigen::RowVector3d(1e-6 * double(f % 7), 0, 0);
    }
    const TriangleMesh both = fixtures::joined(collar, apart);
    EXPECT_EQ(without_scenery(make_garment(both.positions, both.triangles)).rows(), both.triangles.rows());
    EXPECT_EQ(opened(both).left_out.specks, 0);
}

// The border goes to and fro at its edge.
TEST(ClosedEnds, AFaceAtTheRimMayBeTurnedRound)
{
    TriangleMesh open = tube(Cap::none, Cap::none);
    const MeshTopology topology(open.triangles, int(open.positions.rows()));
    open.triangles.row(topology.sides_at(topology.border_edges()[0])[0] / 3).reverseInPlace();
    const MeshTopology turned(open.triangles, int(open.positions.rows()));
    const auto loops = turned.border_loops();
    ASSERT_TRUE(std::any_of(loops.begin(), loops.end(), [](const auto& loop) { return loop.size() == 1; }));
    EXPECT_EQ(opened(open).garment.triangles, open.triangles);
}

TEST(ClosedEnds, BackdropsAreLeftOut)
{
    const TriangleMesh open = tube(Cap::none, Cap::none);
    TriangleMesh flat = fixtures::sheet(2, 1, [](double, double) { return 0; });
    flat.positions.rowwise() -= Eigen::RowVector3d(flat.positions.colwise().mean()) + Eigen::RowVector3d(0, 0.3, 0);
    for (const auto& [size, backdrops] : { std::pair(3.0, 1), std::pair(0.5, 0) }) {
        TriangleMesh scaled = flat;
        scaled.positions *= size;
        if (backdrops == 0)
            scaled.positions.col(1).array() += 0.3;  // through the cloth
        const TriangleMesh both = fixtures::joined(open, scaled);
        const OpenedGarment result = opened(both);
        EXPECT_EQ(result.left_out.backdrops, backdrops) << size;
        EXPECT_EQ(without_scenery(make_garment(both.positions, both.triangles)).rows(),
                  both.triangles.rows() - backdrops * flat.triangles.rows());
    }
    EXPECT_EQ(opened(flat).left_out.backdrops, 0) << "nothing is left of it";
}

TEST(ClosedEnds, AFloorOrAShadowIsLeftOut)
{
    const TriangleMesh open = tube(Cap::none, Cap::none);
    TriangleMesh shadow = fixtures::sheet(2, 1, [](double, double) { return 0; });
    shadow.positions.rowwise() -= Eigen::RowVector3d(shadow.positions.colwise().mean());
    const double width = open.positions.col(0).maxCoeff() - open.positions.col(0).minCoeff();
    shadow.positions *= 1.2 * width / shadow.positions.col(2).maxCoeff() / 2;
    const auto beside = [&](double below) {
        TriangleMesh moved = shadow;
        moved.positions.col(1).array() += open.positions.col(1).minCoeff() - below;
        return moved;
    };
    EXPECT_EQ(opened(fixtures::joined(open, beside(0.02))).left_out.backdrops, 1);
    EXPECT_EQ(opened(fixtures::joined(open, beside(-0.02))).left_out.backdrops, 0) << "it passes through the cloth";
    TriangleMesh label = beside(0.02);
    label.positions.leftCols(1) *= 0.1;
    EXPECT_EQ(opened(fixtures::joined(open, label)).left_out.backdrops, 0) << "it is narrow";
    EXPECT_EQ(opened(fixtures::joined(fixtures::joined(open, beside(0.02)), beside(-0.9))).left_out.backdrops, 0)
        << "flat panels round a body";
}

/// The cloth stays where it is; the vertices behind it lie in one of its own.
void expect_gathered(const OpenedGarment& result, const TriangleMesh& cloth)
{
    const Eigen::Index own = cloth.positions.rows(), others = result.garment.positions.rows() - own;
    EXPECT_EQ(result.garment.positions.topRows(own), cloth.positions);
    const Eigen::RowVector3d place = result.garment.positions.row(own);
    EXPECT_EQ(result.garment.positions.bottomRows(others), place.replicate(others, 1));
    EXPECT_EQ((cloth.positions.rowwise() - place).rowwise().norm().minCoeff(), 0);
}

TEST(ClosedEnds, SolidsAndLidsAreGatheredInOnePlaceOfTheCloth)
{
    const TriangleMesh open = tube(Cap::none, Cap::none);
    TriangleMesh solid = tube(Cap::around_centre, Cap::around_centre, 0, 8);
    solid.positions *= 0.9;
    expect_gathered(opened(fixtures::joined(open, solid)), open);
    const OpenedGarment lidded = opened(fixtures::joined(open, lid(0.01, 0.098)));
    expect_gathered(lidded, open);
    EXPECT_EQ(lidded.left_out.lids, 1);
    EXPECT_EQ(lidded.left_out.faces, k_around - 2);
}

TEST(ClosedEnds, CapsStayWhereTheyAre)
{
    const TriangleMesh capped = tube(Cap::around_centre, Cap::none);
    const OpenedGarment result = opened(capped);
    EXPECT_EQ(result.closed_ends, 1);
    EXPECT_EQ(result.garment.positions, capped.positions);
    EXPECT_EQ(result.left_out.faces, 0);
}

TEST(ClosedEnds, OfSolidsStayClosed)
{
    for (const Cap cap : { Cap::around_centre, Cap::around_corner })
        for (const int around : { 4, 6, 24 })  // a block, a prism, a cylinder
            EXPECT_EQ(opened(tube(cap, cap, 0, around)).closed_ends, 0);
    const TriangleMesh ball = fixtures::polygonise([](const Vec3& p) { return p.norm() - 0.3; }, Vec3::Constant(-0.5),
                                                   Vec3::Constant(0.5), 0.1);
    EXPECT_EQ(opened(ball).closed_ends, 0);
}

}  // namespace
}  // namespace garmentfit
