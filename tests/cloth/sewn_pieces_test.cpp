// SPDX-License-Identifier: GPL-3.0-or-later
#include "sewn_pieces.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "cloth_motion.h"
#include "fixtures.h"
#include "garmentfit/certificate.h"

namespace garmentfit {
namespace {

using fixtures::flat;

GarmentMesh garment_of(const std::vector<TriangleMesh>& pieces)
{
    TriangleMesh all = pieces[0];
    for (std::size_t i = 1; i < pieces.size(); ++i)
        all = fixtures::joined(all, pieces[i]);
    return { all.positions, all.triangles };
}

/// A sheet of 38 cm with a square of 2 cm above its middle, at this height.
GarmentMesh sheet_with_button(double height, double spacing = 0.02)
{
    const int n = int(std::lround(0.38 / spacing)) + 1;
    return garment_of({ flat(n, spacing, Vec3::Zero()), flat(3, 0.01, Vec3(0.187, height, 0.193)) });
}

SewnPieces sewn(const GarmentMesh& garment, const std::vector<int>& garments = {})
{
    return find_sewn_pieces(garment, { garment.triangles, int(garment.positions.rows()) }, garments);
}

void expect_counts(const GarmentMesh& garment, int count, int seamed, int held, int free)
{
    const PieceCounts counts = count_pieces_held(garment);
    EXPECT_EQ(counts.count, count);
    EXPECT_EQ(counts.seamed, seamed);
    EXPECT_EQ(counts.held, held);
    EXPECT_EQ(counts.free, free);
}

std::set<int> tied_vertices(const SewnPieces& pieces)
{
    std::set<int> tied;
    for (const Tie& tie : pieces.ties)
        tied.insert(tie.vertex);
    return tied;
}

Vec3 point_of(const Positions& positions, const Tie& tie)
{
    Vec3 point = Vec3::Zero();
    for (int k = 0; k < 3; ++k)
        point += tie.weights[k] * positions.row(tie.corners[k]).transpose();
    return point;
}

/// A sheet of 38 cm rolled into a tube that is open by `gap` from end to end, or folded onto itself by as much.
GarmentMesh rolled(double gap, bool is_folded = false)
{
    GarmentMesh cloth = garment_of({ flat(20, 0.02, Vec3::Zero()) });
    const double length = 0.38, radius = length / (2 * std::numbers::pi), from = gap / (2 * radius);
    for (auto row : cloth.positions.rowwise()) {
        const double angle = from + row.x() / length * (2 * std::numbers::pi - 2 * from);
        if (is_folded)
            row << std::min(row.x(), length - row.x()), row.x() < length / 2 ? 0 : gap, row.z();
        else
            row << radius * std::cos(angle), radius * std::sin(angle), row.z();
    }
    return cloth;
}

/// A tube of two panels with edges of 2 cm, apart by these gaps on either side, m.
GarmentMesh tube_of_two(double left, double right)
{
    constexpr double radius = 0.12;
    const double first = left / radius, second = right / radius;
    const auto panel = [](double from, double to) {
        TriangleMesh mesh = flat(20, 0.02, Vec3::Zero());
        for (auto row : mesh.positions.rowwise()) {
            const double angle = from + row.x() / 0.38 * (to - from);
            row << radius * std::cos(angle), radius * std::sin(angle), row.z();
        }
        return mesh;
    };
    return garment_of({ panel(first / 2, std::numbers::pi - second / 2),
                        panel(std::numbers::pi + second / 2, 2 * std::numbers::pi - first / 2) });
}

TEST(SewnPieces, DetailsAreSmallAndSewnToCloth)
{
    EXPECT_EQ(sewn(sheet_with_button(0.001)).details.size(), 1u);
    EXPECT_EQ(sewn(sheet_with_button(0.001)).details.front().vertices.size(), 9u);
    EXPECT_TRUE(sewn(sheet_with_button(0.03)).details.empty()) << "a layer of its own";
    const TriangleMesh sheet = flat(20, 0.02, Vec3::Zero()), pocket = flat(8, 0.01, Vec3(0.1, 0.001, 0.1));
    EXPECT_TRUE(sewn(garment_of({ sheet, pocket })).details.empty()) << "7 cm a side bend with the cloth";
    const TriangleMesh beside = flat(3, 0.02, Vec3(0.1, 0, 0.3805));
    EXPECT_EQ(sewn(garment_of({ sheet, beside })).details.size(), 1u) << "by a seam";
}

TEST(SewnPieces, RingsThatAloneHoldTwoPartsTogetherAreLinks)
{
    const auto with_clasp = [](const GarmentMesh& tube, bool is_ring) {
        TriangleMesh clasp = flat(4, 0.01, Vec3(-0.015, 0, 0.18));
        const double radius = 0.38 / (2 * std::numbers::pi);
        for (auto row : clasp.positions.rowwise()) {
            const double y = row.x();
            row << std::sqrt(radius * radius - y * y) + 0.003, y, row.z();
        }
        std::vector<Eigen::Index> kept;
        for (Eigen::Index f = 0; f < clasp.triangles.rows(); ++f)
            if (const Vec3 middle = clasp.positions(clasp.triangles.row(f), Eigen::all).colwise().mean().transpose();
                !is_ring || std::abs(middle.y()) > 0.005 || std::abs(middle.z() - 0.195) > 0.005)
                kept.push_back(f);
        return sewn(
            garment_of({ { tube.positions, tube.triangles }, { clasp.positions, clasp.triangles(kept, Eigen::all) } }));
    };
    const auto is_link = [](const SewnPieces& pieces) { return pieces.details.at(0).is_link(); };
    EXPECT_TRUE(is_link(with_clasp(rolled(0.005), true)));
    EXPECT_FALSE(is_link(with_clasp(rolled(0.005), false))) << "a button";
    EXPECT_FALSE(is_link(with_clasp(rolled(5e-4), true))) << "a seam holds them together as well";
}

TEST(SewnPieces, SeamsMayGapeThatAreHalfOfABorder)
{
    EXPECT_EQ(count_pieces_held(tube_of_two(0.006, 0.006)).seamed, 1);
    EXPECT_EQ(count_pieces_held(tube_of_two(0.012, 0.012)).seamed, 0) << "too far apart";
    EXPECT_EQ(count_pieces_held(tube_of_two(0.006, 0.05)).seamed, 0) << "as the fronts of a jacket";
}

TEST(SewnPieces, APieceHasSeamsWithItself)
{
    const SewnPieces tube = sewn(rolled(5e-4));
    EXPECT_GE(tube.ties.size(), 36u) << "the vertices of both borders, but for corners";
    for (const Tie& tie : tube.ties)
        EXPECT_TRUE(tie.is_seam && tie.is_own);
    EXPECT_EQ(tube.counts.count, 1);
    EXPECT_EQ(tube.counts.seamed, 0);
    EXPECT_TRUE(sewn(rolled(0.01)).ties.empty());
    EXPECT_TRUE(sewn(rolled(5e-4, true)).ties.empty()) << "sheets that lie on each other have no seam at their hem";
}

/// Two strips of 10 cm, welded where both have a vertex: the second one has vertices in the middle of the first one's
/// edges of 2 cm, this far beside them.
GarmentMesh strips_of_two_spacings(double gap)
{
    const int n = 5;
    std::vector<Vec3> places;
    std::vector<std::array<int, 3>> faces;
    for (int i = 0; i <= n; ++i)  // 0 to n: the far border of the first strip, n + 1 to 2 n + 1: the seam
        places.push_back({ 0.02 * i, 0, -0.02 });
    for (int i = 0; i <= n; ++i)
        places.push_back({ 0.02 * i, 0, 0 });
    for (int i = 0; i <= n; ++i)  // the far border of the second strip, then the middles
        places.push_back({ 0.02 * i, 0, 0.02 });
    for (int i = 0; i < n; ++i)
        places.push_back({ 0.02 * i + 0.01, 0, gap });
    for (int i = 0; i < n; ++i) {
        const int low = n + 1 + i, far = 2 * (n + 1) + i, middle = 3 * (n + 1) + i;
        faces.insert(faces.end(),
                     { { i, low, i + 1 },
                       { i + 1, low, low + 1 },
                       { low, far, middle },
                       { middle, far, far + 1 },
                       { middle, far + 1, low + 1 } });
    }
    GarmentMesh strips;
    strips.positions.resize(Eigen::Index(places.size()), 3);
    for (std::size_t v = 0; v < places.size(); ++v)
        strips.positions.row(Eigen::Index(v)) = places[v];
    strips.triangles.resize(Eigen::Index(faces.size()), 3);
    for (std::size_t f = 0; f < faces.size(); ++f)
        strips.triangles.row(Eigen::Index(f)) << faces[f][0], faces[f][1], faces[f][2];
    return strips;
}

TEST(SewnPieces, HolesWithoutAreaAreTiedAcross)
{
    const GarmentMesh strips = strips_of_two_spacings(2e-4);
    const SewnPieces pieces = sewn(strips);
    EXPECT_EQ(tied_vertices(pieces), (std::set<int> { 18, 19, 20, 21, 22 }));
    for (const Tie& tie : pieces.ties) {
        EXPECT_TRUE(tie.is_seam && tie.is_own);
        EXPECT_LT((point_of(strips.positions, tie) - strips.positions.row(tie.vertex).transpose()).norm(), 2.1e-4);
    }
    EXPECT_EQ(pieces.counts.count, 1);
    EXPECT_EQ(pieces.counts.seamed, 0);
    EXPECT_TRUE(sewn(strips_of_two_spacings(4e-3)).ties.empty()) << "holes that one can see";
}

/// How far the ends of ties have moved apart or together.
double largest_change(const GarmentMesh& garment, const Positions& end)
{
    double largest = 0;
    for (const Tie& tie : sewn(garment).ties) {
        const double before = (point_of(garment.positions, tie) - garment.positions.row(tie.vertex).transpose()).norm(),
                     now = (point_of(end, tie) - end.row(tie.vertex).transpose()).norm();
        largest = std::max(largest, std::abs(now - before));
    }
    return largest;
}

/// Where the garment is after falling on a ball and a floor 30 cm under it.
Positions fall(const GarmentMesh& garment)
{
    TriangleMesh floor = fixtures::sheet(2, 1.4, [](double, double) { return -0.3; });
    floor.positions.rowwise() -= Eigen::RowVector3d(0.5, 0, 0.5);
    const TriangleMesh peg
        = fixtures::polygonise([](const Vec3& p) { return (p - Vec3(0.1, -0.06, 0.1)).norm() - 0.05; },
                               Vec3(0.03, -0.13, 0.03), Vec3(0.17, 0.01, 0.17), 0.01);
    const TriangleMesh obstacle = fixtures::joined(floor, peg);
    ClothMotion motion(garment, garment.positions, obstacle, {});
    settle(motion, obstacle.positions, 60, {});
    return motion.cloth();
}

TEST(SewnPieces, SmallOnesAreTiedToTheClothTheyLieOnByEachOfTheirVertices)
{
    const GarmentMesh garment = sheet_with_button(0.004);
    const SewnPieces pieces = sewn(garment);
    ASSERT_EQ(tied_vertices(pieces).size(), 9u);
    for (const Tie& tie : pieces.ties) {
        EXPECT_GE(tie.vertex, 400);
        for (const int corner : tie.corners)
            EXPECT_LT(corner, 400);
        EXPECT_NEAR((point_of(garment.positions, tie) - garment.positions.row(tie.vertex).transpose()).norm(), 0.004,
                    1e-9);
    }
    expect_counts(garment, 2, 0, 1, 0);
}

TEST(SewnPieces, SmallOnesAreTiedHoweverFarTheVerticesUnderThemAre)
{
    expect_counts(sheet_with_button(0.004, 0.095), 2, 0, 1, 0);
}

TEST(SewnPieces, FarFromAnyClothAreFree) { expect_counts(sheet_with_button(0.03), 2, 0, 0, 1); }

/// A sheet of 38 cm on whose middle a strip of 30 cm stands on one end.
GarmentMesh sheet_with_strip(double width, double gap)
{
    constexpr int rows = 31, columns = 3;
    TriangleMesh strip { Positions(rows * columns, 3), Triangles(2 * (rows - 1) * (columns - 1), 3) };
    int f = 0;
    for (int i = 0; i < rows; ++i)
        for (int k = 0; k < columns; ++k) {
            const int here = i * columns + k;
            strip.positions.row(here) << 0.19 + width * (0.5 * k - 0.5), gap + 0.01 * i, 0.19;
            if (i + 1 < rows && k + 1 < columns) {
                strip.triangles.row(f++) << here, here + 1, here + columns;
                strip.triangles.row(f++) << here + 1, here + columns + 1, here + columns;
            }
        }
    return garment_of({ flat(20, 0.02, Vec3::Zero()), strip });
}

TEST(SewnPieces, StrandsHangWhereTheyTouch)
{
    const GarmentMesh garment = sheet_with_strip(0.01, 0.002);
    expect_counts(garment, 2, 0, 1, 0);
    for (const int v : tied_vertices(sewn(garment)))
        EXPECT_LT(garment.positions(v, 1), 0.003);
    expect_counts(sheet_with_strip(0.01, 0.005), 2, 0, 0, 1);  // too far
    expect_counts(sheet_with_strip(0.2, 0.002), 2, 0, 0, 1);  // no strand
}

TEST(PieceShift, IsHowFarAPieceWentFromTheClothThatItLayOn)
{
    const GarmentMesh garment = sheet_with_button(0.004);
    Positions fallen = garment.positions;
    fallen.bottomRows(fallen.rows() - 400).col(1).array() -= 0.2;
    EXPECT_NEAR(longest_piece_shift(garment, fallen), 0.192, 1e-9);  // from 4 mm above to 196 mm below
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(1, Vec3::UnitX()).toRotationMatrix();
    EXPECT_NEAR(longest_piece_shift(garment, garment.positions * turn.transpose()), 0, 1e-9) << "both went together";
}

TEST(PieceShift, IsNoneOfPiecesThatLieBesideNoOther)
{
    const GarmentMesh garment = sheet_with_button(0.08);
    Positions fallen = garment.positions;
    fallen.bottomRows(fallen.rows() - 400).col(1).array() -= 0.2;
    EXPECT_EQ(longest_piece_shift(garment, fallen), 0);
}

TEST(SewnPieces, OneAloneHasNothingToLieOn) { expect_counts(garment_of({ flat(5, 0.02, Vec3::Zero()) }), 1, 0, 0, 0); }

TEST(SewnPieces, OfSeveralGarmentsAreNotSewnToEachOther)
{
    const GarmentMesh garment = sheet_with_button(0.004);
    std::vector<int> garments(400, 0);
    garments.resize(409, 1);
    EXPECT_TRUE(sewn(garment, garments).ties.empty());
}

TEST(SewnPieces, WholeLayersAreNone)
{
    // a sheet of 34 cm that hangs from 5 mm to 3 cm away, as shirts under coats do
    TriangleMesh over = fixtures::sheet(18, 0.02, [](double x, double) { return 0.005 + 0.07 * x; });
    expect_counts(garment_of({ flat(20, 0.02, Vec3::Zero()), over }), 2, 0, 0, 1);
}

TEST(SewnPieces, LiningsLieOnTheirClothWhateverTheirSize)
{
    const GarmentMesh garment = garment_of({ flat(20, 0.02, Vec3::Zero()), flat(18, 0.02, Vec3(0.01, 0.004, 0.01)) });
    expect_counts(garment, 2, 0, 1, 0);
    EXPECT_EQ(tied_vertices(sewn(garment)).size(), std::size_t(18 * 18));
}

TEST(SewnPieces, PanelsAreSewnAlongTheirSeamsOnly)
{
    // side by side, 0.5 mm apart, with other vertices on either side of the seam
    const GarmentMesh garment = garment_of({ flat(20, 0.02, Vec3::Zero()), flat(17, 0.023, Vec3(0.3805, 0, 0.005)) });
    expect_counts(garment, 2, 1, 0, 0);
    const SewnPieces pieces = sewn(garment);
    EXPECT_EQ(tied_vertices(pieces).size(), std::size_t(18 + 17));  // two corners have nothing opposite
    for (const int v : tied_vertices(pieces))
        EXPECT_NEAR(garment.positions(v, 0), 0.38025, 0.001);
}

/// A square of 19 spacings with a second sheet 2 mm below it.
TriangleMesh slab(int n, double spacing, const Vec3& corner)
{
    const TriangleMesh sheet = flat(n, spacing, corner);
    Positions down = Positions::Zero(sheet.positions.rows(), 3);
    down.col(1).setConstant(-0.002);
    return fixtures::thickened(sheet, down);
}

TEST(SewnPieces, PanelsWithThicknessAreSewnAlongTheirRims)
{
    const GarmentMesh garment = garment_of({ slab(20, 0.02, Vec3::Zero()), slab(17, 0.023, Vec3(0.3825, 0, 0.005)) });
    expect_counts(garment, 2, 1, 0, 0);
    const std::set<int> tied = tied_vertices(sewn(garment));
    EXPECT_EQ(tied.size(), std::size_t(2 * (18 + 17)));  // of both sheets
    for (const int v : tied)
        EXPECT_NEAR(garment.positions(v, 0), 0.38125, 0.002);
    expect_counts(garment_of({ slab(20, 0.02, Vec3::Zero()), slab(20, 0.02, Vec3(0.386, 0, 0)) }), 2, 0, 0, 1);
}

/// A flap 38 cm square that stands on a sheet, tilted so that its border is this high at the other end.
GarmentMesh sheet_with_standing_flap(double rise)
{
    TriangleMesh flap = flat(20, 0.02, Vec3::Zero());
    flap.positions = flap.positions(Eigen::all, { 0, 2, 1 }).eval();
    flap.positions.rowwise() += Eigen::RowVector3d(0.01, 0.0005, 0.2);
    flap.positions.col(1) += rise / 0.38 * flap.positions.col(0);
    return garment_of({ flat(25, 0.02, Vec3(-0.03, 0, 0)), flap });
}

TEST(SewnPieces, BordersOnTheSurfaceOfAnotherAreSewnThere)
{
    const GarmentMesh garment = sheet_with_standing_flap(0);
    expect_counts(garment, 2, 0, 1, 0);
    const SewnPieces pieces = sewn(garment);
    EXPECT_EQ(tied_vertices(pieces).size(), 20u);
    for (const int v : tied_vertices(pieces))
        EXPECT_NEAR(garment.positions(v, 1), 0.0005, 1e-9);
}

TEST(SewnPieces, BordersThatOnlyTouchAreNotSewn) { expect_counts(sheet_with_standing_flap(0.03), 2, 0, 0, 1); }

/// A sheet of 58 cm with a pocket of 30 x 30 cm over its middle, whose border is this high and whose middle this much
/// higher. `open` shares of the border's vertices, on either side, stand off as the openings of a hoodie's pocket do.
GarmentMesh sheet_with_pocket(double height, double bulge, double open = 0)
{
    TriangleMesh pocket = fixtures::sheet(16, 0.02, [&](double x, double y) {
        const double across = std::sin(M_PI * x / 0.3), along = std::sin(M_PI * y / 0.3);
        return height + bulge * (open > 0 && std::abs(y - 0.15) < 0.6 * open ? along : across * along);
    });
    pocket.positions.rowwise() += Eigen::RowVector3d(0.14, 0, 0.14);
    return garment_of({ flat(30, 0.02, Vec3::Zero()), pocket });
}

TEST(SewnPieces, PocketsAreSewnAlongTheirBorderOnly)
{
    for (const double height : { 9e-4, 2e-3, 2.9e-3, 8e-3 }) {
        const GarmentMesh garment = sheet_with_pocket(height, 0.03);
        expect_counts(garment, 2, 0, 1, 0);
        const std::set<int> tied = tied_vertices(sewn(garment));
        for (int v = 900; v < 900 + 256; ++v) {
            const int i = (v - 900) % 16, j = (v - 900) / 16;
            EXPECT_EQ(tied.count(v) == 1, i == 0 || j == 0 || i == 15 || j == 15) << v << ", " << height;
        }
    }
}

TEST(SewnPieces, PocketsMayBeOpenAtTheirSides)
{
    const GarmentMesh garment = sheet_with_pocket(2e-3, 0.04, 0.2);
    expect_counts(garment, 2, 0, 1, 0);
    EXPECT_LT(tied_vertices(sewn(garment)).size(), 60u) << "the openings stay open";
}

TEST(SewnPieces, PocketsFarOffTheClothAreNotSewn) { expect_counts(sheet_with_pocket(0.015, 0.03), 2, 0, 0, 1); }

TEST(SewnPieces, RingsAreNotSewnFromAsFarAsPatches)
{
    // a limb could pass through it: a collar, a belt or another layer
    GarmentMesh garment = sheet_with_pocket(8e-3, 0.03);
    std::vector<int> kept;
    for (int f = 0; f < int(garment.triangles.rows()); ++f) {
        const Eigen::RowVector3d middle = garment.positions(garment.triangles.row(f), Eigen::all).colwise().mean();
        if (middle.y() < 1e-9 || (middle - Eigen::RowVector3d(0.29, middle.y(), 0.29)).norm() > 0.08)
            kept.push_back(f);
    }
    garment.triangles = garment.triangles(kept, Eigen::all).eval();
    expect_counts(garment, 2, 0, 0, 1);
}

TEST(SewnPieces, PocketsStayOnClothThatFalls)
{
    for (const double height : { 9e-4, 2.9e-3 }) {
        const GarmentMesh garment = sheet_with_pocket(height, 0.03);
        const Positions end = fall(garment);
        ASSERT_LT(end.col(1).minCoeff(), -0.1);
        EXPECT_LT(largest_change(garment, end), 2e-3) << height;
    }
}

TEST(SewnPieces, AButtonOnAFlapOnACoatIsTiedToTheFlap)
{
    const GarmentMesh garment = garment_of(
        { flat(20, 0.02, Vec3::Zero()), flat(6, 0.02, Vec3(0.1, 0.006, 0.1)), flat(3, 0.01, Vec3(0.14, 0.009, 0.14)) });
    expect_counts(garment, 3, 0, 2, 0);
    for (const Tie& tie : sewn(garment).ties) {
        const bool is_button = tie.vertex >= 436;
        for (const int corner : tie.corners)
            EXPECT_EQ(corner >= 400, is_button) << "the button is tied to the flap, the flap to the coat";
    }
}

TEST(SewnPieces, StayOnClothThatFalls)
{
    for (const double spacing : { 0.02, 0.038 }) {
        const GarmentMesh garment = sheet_with_button(0.004, spacing);
        const Positions end = fall(garment);
        ASSERT_LT(end.col(1).minCoeff(), -0.1) << "it slid off the ball";
        EXPECT_LT(largest_change(garment, end), 2e-3);
    }
}

TEST(SewnPieces, BordersThatNearlyCoincideAreOneCloth)
{
    // 0.01 mm apart: a seam that a format with few digits has cut
    TriangleMesh right = flat(11, 0.02, Vec3(0.2, 0, 0));
    for (Eigen::Index v = 0; v < right.positions.rows(); v += 11)
        right.positions(v, v % 3) += 1e-5;
    const GarmentMesh garment = garment_of({ flat(11, 0.02, Vec3::Zero()), right });
    const PreparedCloth cloth = prepare_cloth(garment, garment.positions);
    EXPECT_EQ(cloth.rest.positions.rows(), 2 * 121 - 11);
    EXPECT_EQ(cloth.sewn.counts.count, 1);
    std::vector<int> garments(121, 0);
    garments.resize(242, 1);
    EXPECT_EQ(prepare_cloth(garment, garment.positions, garments).rest.positions.rows(), 242);
    const Positions end = fall(garment);
    ASSERT_LT(end.col(1).minCoeff(), -0.05);
    for (int i = 0; i < 11; ++i)
        EXPECT_EQ(end.row(11 * i + 10), end.row(121 + 11 * i));
}

TEST(SewnPieces, VerySmallEdgesAreOneVertexButFineMeshesStay)
{
    GarmentMesh garment = garment_of({ flat(5, 0.02, Vec3::Zero()) });
    garment.positions.row(7) = garment.positions.row(6) + Eigen::RowVector3d(1e-7, 0, 0);
    EXPECT_EQ(prepare_cloth(garment, garment.positions).rest.positions.rows(), 24);
    const GarmentMesh fine = garment_of({ flat(5, 1.1e-4, Vec3::Zero()) });
    EXPECT_EQ(prepare_cloth(fine, fine.positions).rest.positions.rows(), 25);
}

TEST(SewnPieces, SeamsDoNotGapeInClothThatFalls)
{
    for (const double gap : { 0.0, 1e-5, 5e-4 }) {
        const GarmentMesh garment
            = garment_of({ flat(11, 0.02, Vec3::Zero()), flat(10, 0.023, Vec3(0.2 + gap, 0, -0.0035)) });
        const Positions end = fall(garment);
        ASSERT_LT(end.col(1).minCoeff(), -0.05) << "it slid off the ball";
        EXPECT_LT(largest_change(garment, end), 1e-3) << gap;
        EXPECT_TRUE(self_crossings({ end, garment.triangles }).empty()) << "borders that touch count as crossing";
    }
}

}  // namespace
}  // namespace garmentfit
