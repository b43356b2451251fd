// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/stand_in.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "crowding.h"
#include "fixtures.h"
#include "garmentfit/certificate.h"
#include "garmentfit/closed_ends.h"
#include "nearest.h"
#include "topology.h"

namespace {

using namespace garmentfit;
using namespace garmentfit::fixtures;

/// A strip of a tube about the y axis, open, from one angle to another.
/// @param n  vertices a side
TriangleMesh strip(double radius, double height, double from, double to, int n)
{
    TriangleMesh mesh = sheet(n, 1. / (n - 1), [](double, double) { return 0; });
    for (auto row : mesh.positions.rowwise()) {
        const double angle = from + (to - from) * row.x();
        row = Eigen::RowVector3d(radius * std::sin(angle), height * row.z(), radius * std::cos(angle));
    }
    return mesh;
}

/// A tube of panels, each closed by its thickness, side by side.
GarmentMesh tube_of_panels(double radius, double height)
{
    constexpr int panels = 8;
    constexpr double thickness = 0.002, turn = 2 * std::numbers::pi / panels, gap = 0.005;
    TriangleMesh all;
    for (int i = 0; i < panels; ++i) {
        const TriangleMesh inner = strip(radius, height, i * turn, (i + 1) * turn - gap, 16);
        Positions outwards = inner.positions;
        outwards.col(1).setZero();
        const TriangleMesh panel = thickened(inner, (thickness / radius * outwards).eval());
        all = all.positions.rows() == 0 ? panel : joined(all, panel);
    }
    return make_garment(all.positions, all.triangles);
}

TriangleMesh ball(double radius, const Vec3& centre)
{
    TriangleMesh mesh = polygonise([&](const Vec3& p) { return p.norm() - radius; }, Vec3::Constant(-2 * radius),
                                   Vec3::Constant(2 * radius), radius / 8);
    mesh.positions.rowwise() += centre.transpose();
    return mesh;
}

const TriangleMesh k_far_body = ball(0.1, Vec3(0, 9, 0));

/// A quarter of a tube, as it is bent.
Positions bent(const Positions& positions)
{
    Positions result = positions;
    for (auto row : result.rowwise()) {
        const double angle = row.y(), radius = 1 - row.x();  // about an axis 1 m to the side
        row << 1 - radius * std::cos(angle), radius * std::sin(angle), row.z();
    }
    return result;
}

/// Two tubes at one radius. One goes up and down through the other by some tenths of a millimetre.
TriangleMesh doubled_sheets(double radius)
{
    TriangleMesh outer = strip(radius, 0.6, 0, 6, 83);
    for (auto row : outer.positions.rowwise()) {
        const double wave = 3e-4 * std::sin(100 * row.y()) * std::cos(40 * row.x());
        row += wave * Eigen::RowVector3d(row.x(), 0, row.z()).normalized();
    }
    return joined(strip(radius, 0.6, 0, 6, 90), outer);
}

TEST(StandIn, OfPanelsIsOneSheetInsideOfThem)
{
    const GarmentMesh panels = tube_of_panels(0.1, 0.6);
    const auto stand_in = make_stand_in(panels);
    ASSERT_TRUE(stand_in);
    EXPECT_TRUE(stand_in->is_needed);
    const MeshTopology topology(stand_in->mesh.triangles, int(stand_in->mesh.positions.rows()));
    EXPECT_GT(topology.border_edges().size(), 0u);
    int beyond = 0;
    for (const auto& place : stand_in->mesh.positions.rowwise())
        beyond += std::hypot(place.x(), place.z()) > 0.1;
    EXPECT_LT(beyond, 0.1 * double(stand_in->mesh.positions.rows())) << "but where it ends within the rims";
    std::vector<int> middle;  // it ends within the rims
    for (int f = 0; f < int(stand_in->mesh.triangles.rows()); ++f)
        if (const Eigen::VectorXd y = stand_in->mesh.positions(stand_in->mesh.triangles.row(f), 1);
            y.minCoeff() > 0.05 && y.maxCoeff() < 0.55)
            middle.push_back(f);
    EXPECT_EQ(crossing_count({ stand_in->mesh.positions, stand_in->mesh.triangles(middle, Eigen::all) },
                             { panels.positions, panels.triangles }),
              0);
}

TEST(StandIn, OfPanelsIsHardlyNarrowerThanThese)
{
    const auto stand_in = make_stand_in(tube_of_panels(0.1, 0.6));
    ASSERT_TRUE(stand_in);
    std::vector<double> radii;
    for (const auto& place : stand_in->mesh.positions.rowwise())
        if (place.y() > 0.1 && place.y() < 0.5)
            radii.push_back(std::hypot(place.x(), place.z()));
    std::sort(radii.begin(), radii.end());
    EXPECT_GT(radii[radii.size() / 2], 0.099) << "the wrap keeps 1.7 mm off";
}

TEST(StandIn, OfAPanelWhoseRimTouchesItselfIsOneSheetToo)
{
    // a sleeve's pattern rolled up: its outer sheet meets along two parts of the seam
    constexpr int n = 40;
    const TriangleMesh inner = strip(0.1, 0.6, 0, 6.25, n);
    Positions outwards = inner.positions;
    outwards.col(1).setZero();
    TriangleMesh panel = thickened(inner, (0.02 * outwards).eval());
    for (const int first : { 5, 20 })
        for (int row = first; row < first + 5; ++row)
            panel.positions.row(n * n + row * n + n - 1) = panel.positions.row(n * n + row * n);
    EXPECT_TRUE(make_stand_in(make_garment(panel.positions, panel.triangles)));
}

TEST(StandIn, ClothOfOneLayerHasNone)
{
    const TriangleMesh tube = strip(0.2, 0.6, 0, 2 * std::numbers::pi, 40);
    EXPECT_FALSE(make_stand_in(make_garment(tube.positions, tube.triangles)));
}

TEST(StandIn, OfClothWithDetailsOfTinyEdgesIsOneSheetToo)
{
    TriangleMesh tube = strip(0.2, 0.6, 0, 6.28, 40), cord = strip(2e-3, 0.02, 0, 6.28, 45);
    cord.positions.col(1).array() += 0.4;
    cord.positions.col(2).array() += 0.205;
    const TriangleMesh both = joined(tube, cord);
    const auto stand_in = make_stand_in(make_garment(both.positions, both.triangles));
    ASSERT_TRUE(stand_in);
    EXPECT_GT(crowding(make_garment(both.positions, both.triangles)), 10);
    EXPECT_LT(crowding(stand_in->mesh), 0.5);
}

/// A tube of cloth with n times n vertices, sewn along its side.
TriangleMesh sewn_tube(int n)
{
    TriangleMesh tube = strip(0.2, 0.6, 0, 2 * std::numbers::pi, n);
    for (int row = 0; row < n; ++row)
        tube.positions.row(row * n + n - 1) = tube.positions.row(row * n);
    return tube;
}

TriangleMesh fine_tube() { return sewn_tube(150); }

TriangleMesh fine_tube_with_button()
{
    TriangleMesh button = strip(4e-3, 2e-3, 0, 6.28, 8);
    button.positions.col(1).array() += 0.3;
    button.positions.col(2).array() += 0.21;
    return joined(fine_tube(), button);
}

TEST(StandIn, OfFineClothIsTheSameSurfaceWithFewerVertices)
{
    const TriangleMesh tube = fine_tube_with_button();
    const auto stand_in = make_stand_in(make_garment(tube.positions, tube.triangles));
    ASSERT_TRUE(stand_in);
    EXPECT_LT(stand_in->mesh.positions.rows(), tube.positions.rows() * 6 / 10);
    EXPECT_GT(stand_in->mesh.positions.rows(), tube.positions.rows() * 3 / 10);
    const TriangleTree surface(tube);
    for (Eigen::Index v = 0; v < stand_in->mesh.positions.rows(); v += 20)
        ASSERT_LT(surface.distance(stand_in->mesh.positions.row(v)), 1e-3);
    EXPECT_EQ(MeshTopology(stand_in->mesh.triangles, int(stand_in->mesh.positions.rows())).border_loops().size(), 2u)
        << "those of the tube: the button has no shape in these triangles";
    EXPECT_FALSE(stand_in->is_needed);
    EXPECT_FALSE(stand_in->is_rough);
}

TEST(StandIn, OfClothOfSomeThousandVerticesIsRough)
{
    const TriangleMesh tube = sewn_tube(80);
    const auto stand_in = make_stand_in(make_garment(tube.positions, tube.triangles));
    ASSERT_TRUE(stand_in);
    EXPECT_LT(stand_in->mesh.positions.rows(), 3000);
    EXPECT_TRUE(stand_in->is_rough);
    EXPECT_FALSE(stand_in->is_needed);
}

/// A tube about the y axis, whose lower end is closed by a fan.
TriangleMesh capped_tube()
{
    constexpr int around = 80, rows = 70;
    TriangleMesh mesh { Positions(around * rows + 1, 3), Triangles(2 * around * (rows - 1) + around, 3) };
    int f = 0;
    for (int i = 0; i < rows; ++i)
        for (int k = 0; k < around; ++k) {
            const double angle = 2 * std::numbers::pi * k / around;
            const int here = i * around + k, next = i * around + (k + 1) % around;
            mesh.positions.row(here) << 0.1 * std::sin(angle), 0.6 * i / rows, 0.1 * std::cos(angle);
            if (i == 0)
                mesh.triangles.row(f++) << around * rows, next, here;
            if (i + 1 == rows)
                continue;
            mesh.triangles.row(f++) << here, next, here + around;
            mesh.triangles.row(f++) << next, next + around, here + around;
        }
    mesh.positions.row(around * rows).setZero();
    return mesh;
}

TEST(StandIn, OfClothWithAClosedEndIsOpenThere)
{
    const TriangleMesh tube = capped_tube();
    const GarmentMesh garment = make_garment(tube.positions, tube.triangles);
    ASSERT_EQ(open_ends(garment).closed_ends, 1);
    const auto stand_in = make_stand_in(garment);
    ASSERT_TRUE(stand_in);
    EXPECT_TRUE(stand_in->is_rough);
    EXPECT_EQ(open_ends(stand_in->mesh).closed_ends, 0) << "remeshed, an end may not be found again";
    const MeshTopology topology(stand_in->mesh.triangles, int(stand_in->mesh.positions.rows()));
    EXPECT_EQ(topology.border_loops().size(), 2u);
}

TEST(StandIn, IsNotRoughWherePiecesMightComeApart)
{
    TriangleMesh lower = sewn_tube(80), upper = lower;
    upper.positions.col(1).array() += 0.601;
    const TriangleMesh both = joined(lower, upper);
    EXPECT_FALSE(make_stand_in(make_garment(both.positions, both.triangles)));
}

TEST(StandIn, TakesFineClothAlongWithoutStrain)
{
    const TriangleMesh tube = fine_tube_with_button();
    const GarmentMesh garment = make_garment(tube.positions, tube.triangles);
    const auto stand_in = make_stand_in(garment);
    ASSERT_TRUE(stand_in);
    const Positions moved = follow(stand_in->mesh, bent(stand_in->mesh.positions), garment, { k_far_body });
    EXPECT_LT((moved - bent(garment.positions)).rowwise().norm().maxCoeff(), 1e-3);
}

TEST(StandIn, OfFineClothThatCrossesItselfIsTheInnerSheetOfAWrap)
{
    TriangleMesh button = strip(4e-3, 2e-3, 0, 6.28, 8);
    button.positions.col(1).array() += 0.3;
    button.positions.col(2).array() += 0.2;
    const TriangleMesh both = joined(fine_tube(), button);
    ASSERT_FALSE(self_crossings(both).empty());
    const auto stand_in = make_stand_in(make_garment(both.positions, both.triangles));
    ASSERT_TRUE(stand_in);
    EXPECT_LT(stand_in->mesh.positions.rows(), both.positions.rows() / 2);
    EXPECT_TRUE(self_crossings({ stand_in->mesh.positions, stand_in->mesh.triangles }).empty());
    EXPECT_FALSE(stand_in->is_needed);
}

TEST(StandIn, TakesAlongASleeveThatHangsBesideTheTrunk)
{
    // a fold of the sleeve is nearer to the trunk than to the sleeve of the stand-in
    const TriangleMesh trunk = strip(0.2, 0.6, 0, 6, 60);
    TriangleMesh sleeve = strip(0.06, 0.5, 0, 6, 50);
    sleeve.positions.col(0).array() += 0.28;  // 2 cm away
    const TriangleMesh led = joined(trunk, sleeve);
    TriangleMesh folded = sleeve;
    for (auto row : folded.positions.rowwise())
        if (row.x() < 0.225 && std::abs(row.y() - 0.25) < 0.05)
            row.x() -= 0.013;
    const TriangleMesh garment = joined(trunk, folded);
    Positions worn = led.positions;
    const Eigen::Index first = trunk.positions.rows();
    worn.bottomRows(worn.rows() - first).col(0).array() += 0.1;  // away from the trunk
    const Positions followed
        = follow({ led.positions, led.triangles }, worn, { garment.positions, garment.triangles }, { k_far_body });
    const Positions moved = followed.bottomRows(followed.rows() - first) - folded.positions;
    EXPECT_GT(moved.col(0).minCoeff(), 0.09);
}

TEST(StandIn, TakesAlongMostOfASleeveThatIsNearerToTheTrunk)
{
    const auto at = [](double height) { return [height](double, double) { return height; }; };
    const TriangleMesh parts = joined(sheet(41, 0.01, at(0)), sheet(41, 0.01, at(0.02)));
    Positions lifted = parts.positions;
    lifted.bottomRows(41 * 41).col(1).array() += 0.5;
    // three quarters of it sag to the trunk
    const TriangleMesh sagging
        = sheet(81, 0.005, [](double x, double) { return x < 0.1 ? 0.02 : std::max(0.008, 0.02 - (x - 0.1)); });
    const Positions followed = follow({ parts.positions, parts.triangles }, lifted,
                                      { sagging.positions, sagging.triangles }, { k_far_body });
    EXPECT_GT((followed - sagging.positions).col(1).minCoeff(), 0.49);
}

TEST(StandIn, LeavesBehindWhatBulgesToAnotherLimb)
{
    // the padded side of a trunk comes to within 5 mm of a sleeve, 4 cm wide, from where it turns away to the rim
    const auto at = [](double height) { return [height](double, double) { return height; }; };
    const TriangleMesh parts = joined(sheet(41, 0.01, at(0)), sheet(41, 0.01, at(0.06)));
    Positions turned = parts.positions;
    for (auto row : turned.bottomRows(41 * 41).rowwise())
        row.y() += std::max(0., row.z());
    const TriangleMesh padded = sheet(81, 0.005, [](double x, double z) {
        return 0.055 * std::clamp(3 - std::abs(x) / 0.01, 0., 1.) * std::clamp(1 + (z + 0.05) / 0.02, 0., 1.);
    });
    const Positions followed
        = follow({ parts.positions, parts.triangles }, turned, { padded.positions, padded.triangles }, { k_far_body });
    EXPECT_LT((followed - padded.positions).col(1).maxCoeff(), 0.02) << "0.08 where it goes with what is nearest";
}

TEST(StandIn, TakesThePartsAlong)
{
    const TriangleMesh tube = strip(0.2, 0.6, 0, 6, 80);
    const GarmentMesh stand_in { tube.positions, tube.triangles }, garment = tube_of_panels(0.205, 0.6);
    const Eigen::AngleAxisd turn(1, Vec3(1, 2, 3).normalized());
    const Positions turned = stand_in.positions * turn.toRotationMatrix().transpose();
    const Positions followed = follow(stand_in, turned, garment, { k_far_body });
    EXPECT_LT((followed - garment.positions * turn.toRotationMatrix().transpose()).rowwise().norm().maxCoeff(), 1e-9);

    const Positions along = follow(stand_in, bent(stand_in.positions), garment, { k_far_body });
    EXPECT_LT((along - bent(garment.positions)).rowwise().norm().maxCoeff(), 0.005);
    EXPECT_EQ(certify(k_far_body, garment, along).self_crossings, 0);
}

TEST(StandIn, LeavesDoubledSheetsNoMoreCrossingsThanTheyWereGivenWith)
{
    const TriangleMesh tube = strip(0.2, 0.6, 0, 6, 80), both = doubled_sheets(0.205);
    const GarmentMesh stand_in { tube.positions, tube.triangles }, garment { both.positions, both.triangles };
    const Certificate bent_one
        = certify(k_far_body, garment, follow(stand_in, bent(stand_in.positions), garment, { k_far_body }));
    EXPECT_GT(bent_one.input_self_crossings, 1000);
    EXPECT_GT(bent_one.shifted_self_crossings, 0);
    EXPECT_EQ(bent_one.self_crossings, 0);
}

TEST(StandIn, MovesSheetsAlikeThatLieOnEachOther)
{
    // two sheets in unlike triangles, .2 mm apart and 20 mm from a stand-in that is thrown into folds
    const TriangleMesh plane = sheet(81, 0.005, [](double, double) { return 0; });
    Positions folded = plane.positions;
    for (auto row : folded.rowwise())
        row.y() = 0.01 * std::sin(150 * row.x()) * std::sin(150 * row.z());
    const auto at = [](double height) { return [height](double, double) { return height; }; };
    const TriangleMesh both = joined(sheet(101, 0.004, at(0.02)), sheet(93, 0.4 / 92, at(0.0202)));
    const GarmentMesh garment { both.positions, both.triangles };
    const Positions followed = follow({ plane.positions, plane.triangles }, folded, garment, { k_far_body });
    const Certificate worn = certify(k_far_body, garment, followed);
    EXPECT_EQ(worn.self_crossings, 0) << "58,662 where each vertex goes its own way";
    EXPECT_LT(worn.strain.p95, 0.2) << "0.74 there";
}

TEST(StandIn, DoesNotHoldWhatOnlyTouchedItself)
{
    // two sheets on each of two parts of a stand-in, as a sleeve on the trunk; then one part is folded and lifted
    const auto at = [](double height) { return [height](double, double) { return height; }; };
    const TriangleMesh parts = joined(sheet(81, 0.005, at(0)), sheet(81, 0.005, at(0.04)));
    Positions lifted = parts.positions;
    for (auto row : lifted.rowwise())
        row.y() = 0.01 * std::sin(150 * row.x()) * std::sin(150 * row.z()) + (row.y() > 0.02 ? 0.5 : 0);
    const TriangleMesh lower = joined(sheet(101, 0.004, at(0.0196)), sheet(93, 0.4 / 92, at(0.0198))),
                       upper = joined(sheet(101, 0.004, at(0.0202)), sheet(93, 0.4 / 92, at(0.0204))),
                       all = joined(lower, upper);
    const GarmentMesh garment { all.positions, all.triangles };
    const Positions followed = follow({ parts.positions, parts.triangles }, lifted, garment, { k_far_body });
    const Eigen::Index own = lower.positions.rows();
    EXPECT_LT(followed.topRows(own).col(1).maxCoeff(), 0.05);
    EXPECT_GT(followed.bottomRows(all.positions.rows() - own).col(1).minCoeff(), 0.42);
    EXPECT_EQ(certify(k_far_body, garment, followed).self_crossings, 0);
}

/// @param gap  m, between the sheets; their file has fewer digits
void expect_to_be_moved_apart(double gap)
{
    const auto at = [](double height) { return [height](double, double) { return height; }; };
    const TriangleMesh plane = sheet(11, 0.05, at(0)),
                       both = joined(sheet(6, 0.1, at(0.01)), sheet(5, 0.125, at(0.01 + gap)));
    const GarmentMesh garment { both.positions, both.triangles };
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(1, Vec3(1, 2, 3).normalized()).toRotationMatrix().transpose();
    const auto crossings_in_file = [&](const Positions& positions) {
        return certify(k_far_body, garment, positions.cast<float>().cast<double>()).self_crossings;
    };
    EXPECT_GT(crossings_in_file(garment.positions * turn), 0);
    const Positions followed
        = follow({ plane.positions, plane.triangles }, plane.positions * turn, garment, { k_far_body });
    EXPECT_EQ(crossings_in_file(followed), 0);
    EXPECT_LT((followed - garment.positions * turn).rowwise().norm().maxCoeff(), 0.05);
}

TEST(StandIn, MovesSheetsApartThatFilesWouldLetCross) { expect_to_be_moved_apart(1e-8); }

TEST(StandIn, MovesSheetsApartThatLayOnEachOther) { expect_to_be_moved_apart(0); }

TEST(StandIn, DoesNotCrossItselfInFoldsThatHaveNoRoom)
{
    // pleats 0.9 mm apart and 12 mm deep; the garment is 6 mm from its stand-in
    constexpr double spacing = 0.003, squeeze = 0.15;
    constexpr int depth = 4;  // edges
    const TriangleMesh flat = sheet(65, spacing, [](double, double) { return 0; });
    Positions pleated = flat.positions;
    for (auto row : pleated.rowwise()) {
        const int at = int(std::lround(row.x() / spacing)) % (2 * depth);
        row.x() *= squeeze;
        row.y() = (at < depth ? at : 2 * depth - at) * spacing * std::sqrt(1 - squeeze * squeeze);
    }
    const TriangleMesh outer = sheet(129, spacing / 2, [](double, double) { return 2 * spacing; });
    const GarmentMesh garment { outer.positions, outer.triangles };
    const Positions followed = follow({ flat.positions, flat.triangles }, pleated, garment, { k_far_body });
    EXPECT_EQ(certify(k_far_body, garment, followed).self_crossings, 0) << "3,584 where only what meets is drawn in";
    double longest = 0;
    const Edges edges = edges_of(garment.triangles);
    for (const auto& edge : edges.rowwise()) {
        const auto length = [&](const Positions& x) { return (x.row(edge[0]) - x.row(edge[1])).norm(); };
        longest = std::max(longest, length(followed) / length(garment.positions));
    }
    EXPECT_LT(longest, 1.5) << "2.2 there";
}

TEST(StandIn, PushesOutWhatWouldMeetTheBody)
{
    // the stand-in is wide enough for the ball, a sheet inside of it is not
    const TriangleMesh tube = strip(0.2, 0.6, 0, 6, 60), inner = strip(0.18, 0.6, 0, 6, 60);
    const GarmentMesh stand_in { tube.positions, tube.triangles }, garment { inner.positions, inner.triangles };
    const Surroundings around { ball(0.19, Vec3(0, 0.3, 0)) };
    ASSERT_GT(crossing_count({ garment.positions, garment.triangles }, around.body), 0);
    const Positions followed = follow(stand_in, stand_in.positions, garment, around);
    EXPECT_TRUE(certify(around.body, garment, followed).clean());
    EXPECT_LT((followed - garment.positions).rowwise().norm().minCoeff(), 1e-6) << "what is clear stays";
}

TEST(StandIn, PushesOutEdgesThatPassThroughTheBodyBetweenVerticesOutside)
{
    // with twelve vertices round it, the garment is nearer to its axis between them
    const TriangleMesh tube = strip(0.2, 0.6, 0, 6, 60), coarse = strip(0.2, 0.6, 0, 6, 12);
    const GarmentMesh stand_in { tube.positions, tube.triangles }, garment { coarse.positions, coarse.triangles };
    const Surroundings around { ball(0.197, Vec3(0, 0.3, 0)) };
    ASSERT_GT((garment.positions.rowwise() - Eigen::RowVector3d(0, 0.3, 0)).rowwise().norm().minCoeff(), 0.2);
    ASSERT_GT(crossing_count({ garment.positions, garment.triangles }, around.body), 0);
    const Positions followed = follow(stand_in, stand_in.positions, garment, around);
    EXPECT_TRUE(certify(around.body, garment, followed).clean());
    EXPECT_LT((followed - garment.positions).rowwise().norm().maxCoeff(), 0.04) << "no further than it has to";
}

TEST(StandIn, AfterTheDeadlineGarmentsGoAlongOnly)
{
    const TriangleMesh tube = strip(0.2, 0.6, 0, 6, 60), inner = strip(0.18, 0.6, 0, 6, 60);
    const GarmentMesh stand_in { tube.positions, tube.triangles }, garment { inner.positions, inner.triangles };
    const Surroundings around { ball(0.19, Vec3(0, 0.3, 0)) };
    const Positions late = follow(stand_in, stand_in.positions, garment, around, Progress().until(Deadline::in(1e-9)));
    EXPECT_LT((late - garment.positions).rowwise().norm().maxCoeff(), 1e-9);
}

TEST(StandIn, GivesSheetsTheirGapsAgainBesideTheBody)
{
    // the sheet inside is pushed out through the two around it, which cross as given
    const TriangleMesh tube = strip(0.2, 0.6, 0, 6, 60), inside = strip(0.193, 0.6, 0, 6, 60);
    const TriangleMesh doubled = doubled_sheets(0.197);
    const TriangleMesh all = joined(doubled, inside);
    const GarmentMesh stand_in { tube.positions, tube.triangles }, garment { all.positions, all.triangles };
    const Surroundings around { ball(0.195, Vec3(0, 0.3, 0)) };
    ASSERT_GT(crossing_count({ garment.positions, garment.triangles }, around.body), 0);
    const Certificate worn = certify(around.body, garment, follow(stand_in, stand_in.positions, garment, around));
    EXPECT_GT(worn.input_self_crossings, 1000);
    EXPECT_EQ(worn.self_crossings, 0);
    EXPECT_TRUE(worn.clean());
}

/// An arch of cloth along z, as between two trouser legs. Its sides are twice `half` apart.
TriangleMesh arch(double half, double top, double edge)
{
    const int n = int(0.3 / edge) | 1;
    TriangleMesh mesh = sheet(n, 1. / (n - 1), [](double, double) { return 0; });
    const double quarter = half * std::numbers::pi / 2;
    for (auto row : mesh.positions.rowwise()) {
        const double along = 0.3 * (row.x() - 0.5), z = 0.3 * (row.z() - 0.5), down = std::abs(along) - quarter;
        row << (down < 0 ? half * std::sin(along / half) : std::copysign(half, along)),
            top - half + (down < 0 ? half * std::cos(along / half) : -down), z;
    }
    return mesh;
}

TEST(StandIn, TakesDoubledClothThroughANarrowCrotch)
{
    // thighs 6 mm apart and wider apart below; pushed away from one of them, cloth is pushed into the other
    const auto thighs = [](const Vec3& p) {
        const double leg = std::hypot(std::abs(p.x()) - 0.103 + 0.05 * p.y(), p.z()) - 0.1,
                     trunk = std::max(std::hypot(p.x() / 2, p.z()) - 0.1, 0.02 - p.y());
        return std::max(std::min(leg, trunk), std::abs(p.y()) - 0.2);
    };
    const Surroundings around { polygonise(thighs, Vec3(-0.28, -0.25, -0.15), Vec3(0.28, 0.25, 0.15), 0.006) };
    const TriangleMesh between = arch(0.0015, 0.012, 0.012);
    const GarmentMesh stand_in { between.positions, between.triangles };
    for (const double top : { 0.012, 0.018, 0.024 }) {
        const TriangleMesh sheets = joined(arch(0.0012, top - 0.002, 0.008), arch(0.0052, top, 0.008));
        const GarmentMesh garment { sheets.positions, sheets.triangles };
        ASSERT_GT(crossing_count(sheets, around.body), 0);
        const Certificate worn = certify(around.body, garment, follow(stand_in, stand_in.positions, garment, around));
        EXPECT_TRUE(worn.clean()) << top << ": " << worn.body_crossings << " crossings with the body";
    }
}

}  // namespace
