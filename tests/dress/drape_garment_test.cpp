// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/drape_garment.h"
#include "topology.h"
#include "used_vertices.h"

#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "fixtures.h"
#include "garmentfit/error.h"
#include "garmentfit/fit_skeleton.h"
#include "garmentfit/io.h"
#include "garmentfit/recover_pose.h"
#include "garmentfit/rig_body.h"

namespace {

using namespace garmentfit;
using namespace garmentfit::fixtures;

constexpr double k_degree = M_PI / 180;

struct Dressing {
    BodyMesh body;
    Rig rig;
};

// Legs raised forward by `hip_angle` degrees, arms out of the way.
Dressing person(double hip_angle = 0)
{
    PersonOptions options;
    options.arm_angle = 20;
    options.hip_angle = hip_angle;
    const TriangleMesh mesh = capsule_person(options).mesh;
    Dressing result;
    result.body = make_body(mesh.positions, mesh.triangles);
    result.rig = rig_body(result.body);
    return result;
}

// Brings the thighs of person(hip_angle) straight down.
Pose standing_pose(double hip_angle)
{
    Pose pose;
    for (const int thigh : { lfemur, rfemur })
        pose.rotations[thigh] = Eigen::Quaterniond(Eigen::AngleAxisd(hip_angle * k_degree, Vec3::UnitX()));
    return pose;
}

// Round a standing person, `ease` metres off the skin.
GarmentMesh trousers(double ease)
{
    const TriangleMesh mesh = garment_round(
        person_skeleton({}), ease, [](const Vec3& p) { return p.y() > 0.2 && p.y() < 1.0 && std::abs(p.x()) < 0.26; });
    return make_garment(mesh.positions, mesh.triangles);
}

// In the pose of the input, with a garment on that keeps its rest shape.
DressedBody wearing(const GarmentMesh& garment) { return { {}, {}, { { garment, garment.positions, {} } } }; }

/// A progress whose deadline passes at a fraction of the work, or before.
Progress late_at(double fraction)
{
    const Deadline deadline = Deadline::in(0.5);
    const auto wait = [fraction, deadline](double done, std::string_view) {
        while (done >= fraction && !deadline.has_passed())
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        return true;
    };
    return Progress(wait).until(deadline);
}

DrapeOptions short_settling()
{
    DrapeOptions options;
    options.settling_steps = 10;
    return options;
}

TEST(DrapeGarment, IsCertifiedAndTheBodyReachesItsFullSize)
{
    const Dressing d = person();
    const GarmentMesh garment = trousers(0.02);
    const DrapeResult result = drape_garment(d.rig, d.body, {}, garment, short_settling());
    EXPECT_TRUE(result.certified);
    EXPECT_EQ(result.scale_reached, 1);
    EXPECT_TRUE(result.too_tight.empty());
    EXPECT_EQ(result.body, d.body.surface.positions);
    ASSERT_EQ(result.garments.size(), 1u);
    EXPECT_GT(result.garments[0].certificate.min_distance, 0);
    EXPECT_EQ(result.garments[0].rest.positions, garment.positions);
    EXPECT_LT(result.garments[0].certificate.strain.p95, 0.05);
}

/// Trousers with a square of 2 cm that lies 4 mm off the front of the left thigh.
GarmentMesh trousers_with_badge()
{
    const GarmentMesh cloth = trousers(0.02);
    TriangleMesh badge = sheet(3, 0.01, [](double, double) { return 0; });
    badge.positions = badge.positions(Eigen::all, { 0, 2, 1 }).eval();  // upright, at z = 0
    badge.positions.rowwise() += Eigen::RowVector3d(0.12, 0.6, 0);
    double front = -1;
    for (Eigen::Index v = 0; v < cloth.positions.rows(); ++v)
        if ((cloth.positions.row(v).head(2) - badge.positions.row(4).head(2)).norm() < 0.05)
            front = std::max(front, cloth.positions(v, 2));
    badge.positions.col(2).array() += front + 0.004;
    const TriangleMesh both = joined({ cloth.positions, cloth.triangles }, badge);
    return make_garment(both.positions, both.triangles);
}

/// The same with a fan of faces over each of these openings.
GarmentMesh with_caps(const GarmentMesh& garment)
{
    const MeshTopology topology(garment.triangles, int(garment.positions.rows()));
    GarmentMesh capped = garment;
    for (const std::vector<int>& loop : topology.border_loops()) {
        const Eigen::Index centre = capped.positions.rows(), first = capped.triangles.rows(), n = int(loop.size());
        capped.positions.conservativeResize(centre + 1, 3);
        const Eigen::RowVector3d mean = garment.positions(loop, Eigen::all).colwise().mean();
        for (const int v : loop)
            capped.positions(v, 1) = mean.y();  // the fixture's hems are jagged
        capped.positions.row(centre) = mean;
        capped.triangles.conservativeResize(first + n, 3);
        for (Eigen::Index k = 0; k < n; ++k)
            capped.triangles.row(first + k) << loop[(k + 1) % n], loop[k], int(centre);
    }
    return capped;
}

TEST(DrapeGarment, LeavesOutTheCapsOfClosedEnds)
{
    const Dressing d = person();
    const GarmentMesh capped = with_caps(trousers(0.02));
    const DrapeResult result = drape_garment(d.rig, d.body, {}, capped, short_settling());
    EXPECT_TRUE(result.certified);
    EXPECT_EQ(result.scale_reached, 1);
    EXPECT_EQ(result.garments.back().closed_ends, 3);
    EXPECT_EQ(result.garments.back().positions.rows(), capped.positions.rows());
    EXPECT_EQ(fit_skeleton(d.rig, capped).closed_ends, 3);
}

/// With an egg in the upper part.
GarmentMesh with_filling(const GarmentMesh& garment)
{
    const Positions used = garment.positions(used_vertices(garment.triangles), Eigen::all);
    const Vec3 low = used.colwise().minCoeff(), high = used.colwise().maxCoeff(),
               half = Vec3(0.4, 0.2, 0.4).cwiseProduct(high - low);
    const Vec3 centre(0.5 * (low.x() + high.x()), high.y() - half.y(), 0.5 * (low.z() + high.z()));
    const TriangleMesh egg
        = fixtures::polygonise([&](const Vec3& p) { return (p - centre).cwiseQuotient(half).norm() - 1; },
                               centre - 1.2 * half, centre + 1.2 * half, 0.25 * half.minCoeff());
    const TriangleMesh filled = fixtures::joined({ garment.positions, garment.triangles }, egg);
    return { filled.positions, filled.triangles };
}

TEST(DrapeGarment, DrawsWhatFillsAGarmentIntoOnePointOfIt)
{
    const Dressing d = person();
    const GarmentMesh cloth = trousers(0.02), filled = with_filling(cloth);
    const DrapeResult result = drape_garment(d.rig, d.body, {}, filled, short_settling());
    const WornGarment& worn = result.garments.back();
    EXPECT_TRUE(result.certified);
    EXPECT_EQ(worn.left_out.solids, 1);
    EXPECT_EQ(worn.left_out.faces, filled.triangles.rows() - cloth.triangles.rows());
    const Eigen::Index own = cloth.positions.rows(), others = filled.positions.rows() - own;
    ASSERT_EQ(worn.positions.rows(), own + others);
    const Eigen::RowVector3d place = worn.positions.row(own);
    EXPECT_EQ(worn.positions.bottomRows(others), place.replicate(others, 1));
    EXPECT_EQ((worn.positions.topRows(own).rowwise() - place).rowwise().norm().minCoeff(), 0);
}

TEST(DrapeGarment, KeepsPiecesWhereTheyAreSewnAndCountsThem)
{
    const Dressing d = person();
    const GarmentMesh garment = trousers_with_badge();
    const DrapeResult result = drape_garment(d.rig, d.body, {}, garment, short_settling());
    const WornGarment& worn = result.garments.back();
    EXPECT_EQ(worn.pieces.count, 2);
    EXPECT_EQ(worn.pieces.held, 1);
    EXPECT_EQ(worn.pieces.free, 0);
    const auto nearest = [&](const Positions& at) {  // of a vertex of the badge, over the trousers' vertices
        const Eigen::Index cloth = at.rows() - 9;
        return (at.topRows(cloth).rowwise() - at.row(cloth + 4)).rowwise().norm().minCoeff();
    };
    EXPECT_NEAR(nearest(worn.positions), nearest(garment.positions), 3e-3);
}

TEST(DrapeGarment, SaysHowFarAGarmentSlipsThatIsTooWideToStay)
{
    const Dressing d = person();
    const TriangleMesh wide = garment_round(
        person_skeleton({}), 0.15, [](const Vec3& p) { return p.y() > 0.75 && p.y() < 1.0 && std::abs(p.x()) < 0.4; });
    DrapeOptions options;
    options.settling_steps = 30;
    const DrapeResult result = drape_garment(d.rig, d.body, {}, make_garment(wide.positions, wide.triangles), options);
    EXPECT_GT(result.garments[0].slipped, 0.1);
    EXPECT_LT(drape_garment(d.rig, d.body, {}, trousers(0.02), short_settling()).garments[0].slipped, 0.06);
}

TEST(DrapeGarment, SaysWhereATooSmallGarmentIsTooTight)
{
    const Dressing d = person();
    const DrapeResult result = drape_garment(d.rig, d.body, {}, trousers(-0.03), short_settling());
    EXPECT_FALSE(result.certified);
    EXPECT_LT(result.scale_reached, 1);
    ASSERT_FALSE(result.too_tight.empty());
    // 3 cm all round are 19 cm of girth
    EXPECT_NEAR(result.too_tight[0].missing_girth, 2 * M_PI * 0.03, 0.05);
    EXPECT_TRUE(result.garments[0].certificate.clean());  // as far as it came, nothing crosses
}

/// Each triangle with vertices of its own, as if seams of UVs ran along all edges.
GarmentMesh in_own_vertices(const GarmentMesh& garment)
{
    Triangles own(garment.triangles.rows(), 3);
    for (Eigen::Index k = 0; k < own.size(); ++k)
        own.data()[k] = int(k);
    const std::vector<int> corners(garment.triangles.data(), garment.triangles.data() + garment.triangles.size());
    return { garment.positions(corners, Eigen::all), own };
}

TEST(DrapeGarment, FeetLeaveLegsThatSeamsOfUVsCutOpen)
{
    const Dressing d = person();
    const GarmentMesh leg = sleeve_round(d.rig.skeleton, ltibia, 0.06, 0.05, d.rig.skeleton.length(ltibia) + 0.1);
    for (const GarmentMesh& garment : { leg, in_own_vertices(leg) }) {
        const DrapeResult result = drape_garment(d.rig, d.body, {}, garment, short_settling());
        EXPECT_TRUE(result.certified);
        EXPECT_EQ(result.scale_reached, 1);
        EXPECT_LT(result.garments[0].certificate.strain.max, 0.3) << "a foot that grows inside stretches it by 1.5";
    }
}

TEST(DrapeGarment, MakesATooSmallGarmentLargerWhereThatIsAllowed)
{
    const Dressing d = person();
    const GarmentMesh small = trousers(-0.016);
    DrapeOptions options = short_settling();
    options.cloth.largest_enlargement = 1;
    const DrapeResult result = drape_garment(d.rig, d.body, {}, small, options);
    EXPECT_TRUE(result.certified);
    EXPECT_EQ(result.scale_reached, 1);
    ASSERT_EQ(result.garments.size(), 1u);
    const double size = result.garments[0].size;
    EXPECT_GT(size, 1.05);
    EXPECT_LT(size, 1.5);
    EXPECT_EQ(result.garments[0].rest.positions, size * small.positions);
    options.size = size + 0.1;
    EXPECT_EQ(drape_garment(d.rig, d.body, {}, small, options).garments[0].size, options.size);
    options.size = 1;
    options.cloth.largest_enlargement = 0.5 * (size - 1);
    EXPECT_LT(drape_garment(d.rig, d.body, {}, small, options).scale_reached, 1);
}

TEST(DrapeGarment, RefusesAGarmentThatTheSkeletonPassesThrough)
{
    const Dressing d = person();
    GarmentMesh aside = trousers(0.02);
    aside.positions.col(0).array() += 0.12;
    try {
        drape_garment(d.rig, d.body, {}, aside);
        FAIL() << "took a garment beside the body";
    } catch (const InvalidInput& error) {
        EXPECT_NE(std::string(error.what()).find("bone"), std::string::npos) << error.what();
    }
}

// With a patch of 2 cm beside the left shin, so far from its middle.
GarmentMesh trousers_with_patch(const Skeleton& skeleton, double distance)
{
    GarmentMesh result = trousers(0.02);
    const Vec3 middle = 0.5 * (skeleton.head(ltibia) + skeleton.tail(ltibia)), along = skeleton.direction(ltibia);
    const Vec3 beside = Vec3::UnitX() - along.x() * along, across = along.cross(beside);
    const int first = int(result.positions.rows());
    result.positions.conservativeResize(first + 4, 3);
    for (int corner = 0; corner < 4; ++corner)
        result.positions.row(first + corner) = middle + distance * beside.normalized()
            + 0.02 * ((corner % 2 ? 1 : -1) * along + (corner / 2 ? 1 : -1) * across.normalized());  // no speck
    result.triangles.conservativeResize(result.triangles.rows() + 2, 3);
    result.triangles.bottomRows(2) << first, first + 1, first + 2, first + 1, first + 3, first + 2;
    return result;
}

TEST(DrapeGarment, MovesABareBodyALittleWhereItsBonesLieAcrossTheCloth)
{
    const Dressing d = person();
    GarmentMesh garment = trousers(0.02);
    double front = -1;  // of the left leg
    for (const auto& p : garment.positions.rowwise())
        if (p.x() > 0.08 && std::abs(p.y() - 0.6) < 0.05)
            front = std::max(front, p.z());
    const double beyond = 0.004;
    garment.positions.col(2).array() -= front + beyond - d.rig.skeleton.tail(lfemur).z();
    const DrapeResult result = drape_garment(d.rig, d.body, {}, garment, short_settling());
    EXPECT_TRUE(result.certified);
    const double moved = result.pose.root_translation.norm();
    EXPECT_GT(moved, beyond);
    EXPECT_LT(moved, 0.031);
    EXPECT_TRUE(recover_pose(d.rig, d.body, result, Pose()).certified);

    const DressedBody held { {}, d.body.surface.positions, {} };  // has to stay where it is
    EXPECT_THROW(drape_garment(d.rig, d.body, held, garment, short_settling()), InvalidInput);
}

TEST(DrapeGarment, StartsThinnerWhereClothIsVeryNearToABone)
{
    const Dressing d = person();
    const GarmentMesh garment = trousers_with_patch(d.rig.skeleton, 3e-4);
    const DrapeResult result = drape_garment(d.rig, d.body, {}, garment, short_settling());
    EXPECT_TRUE(result.certified);
    EXPECT_EQ(result.scale_reached, 1);
    const DressedBody held { {}, d.body.surface.positions, {} };  // has to stay where it is
    EXPECT_THROW(drape_garment(d.rig, d.body, held, trousers_with_patch(d.rig.skeleton, 0), short_settling()),
                 InvalidInput);
}

TEST(DrapeGarment, PutsASecondGarmentOverTheFirst)
{
    const Dressing d = person();
    const DrapeResult inner = drape_garment(d.rig, d.body, {}, trousers(0.012), short_settling());
    ASSERT_TRUE(inner.certified);
    const DrapeResult both = drape_garment(d.rig, d.body, inner, trousers(0.04), short_settling());
    EXPECT_TRUE(both.certified);
    ASSERT_EQ(both.garments.size(), 2u);
    EXPECT_EQ(both.garments[1].certificate.layer_crossings, 0);
    EXPECT_EQ(both.garments[0].positions, inner.garments[0].positions);
}

TEST(DrapeGarment, LeavesInnerGarmentsCleanWhereTheOuterOneIsTooSmall)
{
    const Dressing d = person();
    const DrapeResult inner = drape_garment(d.rig, d.body, {}, trousers(0.012), short_settling());
    const DrapeResult both = drape_garment(d.rig, d.body, inner, trousers(-0.03), short_settling());
    EXPECT_FALSE(both.certified);
    EXPECT_LT(both.scale_reached, 1);
    ASSERT_FALSE(both.too_tight.empty());
    EXPECT_EQ(both.too_tight[0].garment, 1);
    for (const WornGarment& garment : both.garments)
        EXPECT_TRUE(garment.certificate.clean());
    EXPECT_EQ(crossing_count({ both.garments[0].positions, both.garments[0].rest.triangles },
                             { both.body, d.body.surface.triangles }),
              0);
}

TEST(DrapeGarment, StopsWhenToldTo)
{
    const Dressing d = person();
    const Progress stop([](double fraction, std::string_view) { return fraction < 0.2; });
    EXPECT_THROW(drape_garment(d.rig, d.body, {}, trousers(0.02), {}, stop), Cancelled);
}

TEST(DrapeGarment, EndsCleanAtTheScaleReachedWhenTimeRunsOut)
{
    const Dressing d = person();
    const DrapeResult result = drape_garment(d.rig, d.body, {}, trousers(0.02), {}, late_at(0.3));
    EXPECT_TRUE(result.out_of_time);
    EXPECT_FALSE(result.certified);
    EXPECT_LT(result.scale_reached, 1);
    EXPECT_TRUE(result.too_tight.empty()) << "the garment is not too small";
    ASSERT_EQ(result.garments.size(), 1u);
    EXPECT_TRUE(result.garments[0].certificate.clean());
    EXPECT_FALSE(drape_garment(d.rig, d.body, {}, trousers(0.02), short_settling()).out_of_time);
}

TEST(DrapeGarment, IsCertifiedButNotSettledWhenTimeRunsOutAtFullSize)
{
    const Dressing d = person();
    DrapeOptions endless;
    endless.settling_steps = 10000;
    const DrapeResult result = drape_garment(d.rig, d.body, {}, trousers(0.02), endless, late_at(0.701));
    EXPECT_TRUE(result.out_of_time);
    EXPECT_TRUE(result.scale_reached < 1 || result.certified) << "a slow machine may be late before";
}

TEST(RecoverPose, BringsTheBodyBackBitForBitWithTheGarmentOn)
{
    const Dressing d = person(35);
    const DrapeResult draped = drape_garment(d.rig, d.body, { standing_pose(35) }, trousers(0.025), short_settling());
    ASSERT_TRUE(draped.certified);
    std::vector<double> fractions;
    const Progress progress([&](double fraction, std::string_view) { return fractions.push_back(fraction), true; });
    RecoverOptions options;
    options.frames = 5;
    const RecoverResult result = recover_pose(d.rig, d.body, draped, Pose(), options, progress);
    EXPECT_TRUE(result.certified);
    EXPECT_EQ(result.pose_reached, 1);
    EXPECT_EQ(result.body, d.body.surface.positions);
    EXPECT_GT(result.garments[0].certificate.min_distance, 0);
    EXPECT_LT(result.garments[0].certificate.strain.p95, 0.15);
    EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
    ASSERT_EQ(result.frames.size(), 5u);
    EXPECT_EQ(result.frames.front().garments[0], draped.garments[0].positions);
    EXPECT_EQ(result.frames.back().garments[0], result.garments[0].positions);
    EXPECT_EQ(result.frames.back().body, result.body);
    for (const RecoverFrame& frame : result.frames)
        EXPECT_EQ(crossing_count({ frame.garments[0], draped.garments[0].rest.triangles },
                                 { frame.body, d.body.surface.triangles }),
                  0);
    // the thighs, and with them the cloth at the knees, came forward
    EXPECT_GT(result.garments[0].positions.col(2).maxCoeff(), draped.garments[0].positions.col(2).maxCoeff() + 0.15);
}

TEST(RecoverPose, LeadsClothToRestUnlessADraftWillDo)
{
    const Dressing d = person(35);
    const DrapeResult draped = drape_garment(d.rig, d.body, { standing_pose(35) }, trousers(0.025), short_settling());
    ASSERT_TRUE(draped.certified);
    RecoverOptions options;
    options.quality = Quality::draft;
    const RecoverResult draft = recover_pose(d.rig, d.body, draped, Pose(), options);
    options.quality = Quality::standard;
    const RecoverResult rest = recover_pose(d.rig, d.body, draped, Pose(), options);
    ASSERT_TRUE(draft.residual && rest.residual);
    EXPECT_TRUE(draft.certified && rest.certified);
    EXPECT_EQ(rest.body, d.body.surface.positions);
    EXPECT_FALSE(draft.residual->is_at_rest());
    EXPECT_TRUE(rest.residual->is_at_rest()) << rest.residual->mean << ' ' << rest.residual->percentile_99;
}

TEST(RecoverPose, ReturnsAsManyFramesAsAskedForAndOneIsTheEnd)
{
    const Dressing d = person();
    const GarmentMesh rest = trousers(0.02);
    RecoverOptions options;
    options.settling_steps = 2;
    options.quality = Quality::draft;
    for (const int frames : { 1, 12 }) {  // the body stands in the pose already: one step would do
        options.frames = frames;
        const RecoverResult result = recover_pose(d.rig, d.body, wearing(rest), Pose(), options);
        ASSERT_EQ(result.frames.size(), std::size_t(frames));
        for (int i = 0; i < frames; ++i)
            EXPECT_NEAR(result.frames[i].share, frames > 1 ? double(i) / (frames - 1) : 1, 1e-9);
        EXPECT_EQ(result.frames.back().garments[0], result.garments[0].positions);
    }
}

TEST(RecoverPose, CarriesTheBodyAndItsClothesAsOneToTheirPlace)
{
    const Dressing d = person();
    const DressedBody here = wearing(trousers(0.01));
    RecoverOptions options;
    options.settling_steps = 2;
    options.quality = Quality::draft;
    options.frames = 3;
    const RecoverResult expected = recover_pose(d.rig, d.body, here, Pose(), options);

    DressedBody there = here;  // three metres away, its back turned
    there.pose.root_translation = Vec3(3, 0, 0);
    there.pose.root_rotation = Eigen::Quaterniond(Eigen::AngleAxisd(180 * k_degree, Vec3::UnitY()));
    const Vec3& root = d.rig.skeleton.root;
    Positions& cloth = there.garments[0].positions;
    cloth = ((cloth.rowwise() - root.transpose()) * there.pose.root_rotation.toRotationMatrix().transpose()).rowwise()
        + (root + there.pose.root_translation).transpose();
    const Positions start = cloth;
    const RecoverResult result = recover_pose(d.rig, d.body, there, Pose(), options);
    EXPECT_TRUE(result.certified);
    EXPECT_EQ(result.body, d.body.surface.positions);
    const Eigen::VectorXd apart = (result.garments[0].positions - expected.garments[0].positions).rowwise().norm();
    EXPECT_LT(apart.mean(), 3e-3);  // rounding decides which contacts are active, and the cloth slides for a second
    EXPECT_LT(apart.maxCoeff(), 1e-2);
    ASSERT_EQ(result.frames.size(), 3u);
    EXPECT_EQ(result.frames[0].garments[0], start);
    EXPECT_NEAR(result.frames[1].garments[0].col(0).mean(), 1.5, 0.2) << "half way";
}

TEST(RecoverPose, SaysWhereAGarmentIsTooSmallForThePoseAndStaysClean)
{
    const Dressing d = person();
    GarmentMesh rest = trousers(0.01);
    const Positions worn = rest.positions;
    rest.positions *= 0.75;
    const RecoverResult result = recover_pose(d.rig, d.body, { {}, {}, { { rest, worn, {} } } }, Pose());
    EXPECT_FALSE(result.certified);
    ASSERT_FALSE(result.too_tight.empty());
    EXPECT_EQ(result.too_tight[0].garment, 0);
    EXPECT_GT(result.too_tight[0].missing_girth, 0.02);
    EXPECT_EQ(result.pose_reached, 1);
    EXPECT_EQ(result.body, d.body.surface.positions);
    EXPECT_EQ(result.garments[0].certificate.body_crossings, 0);
}

TEST(RecoverPose, BringsPartsThatWereHeldBackToTheirPlaces)
{
    const Dressing d = person();
    const GarmentMesh loose = trousers(0.02);
    const Positions& skin = d.body.surface.positions;
    const Positions held_back = skin - 4e-3 * vertex_normals(skin, d.body.surface.triangles);
    DressedBody start = wearing(loose);
    start.body = held_back;
    const RecoverResult result = recover_pose(d.rig, d.body, start, Pose());
    EXPECT_TRUE(result.certified);
    EXPECT_EQ(result.body, skin);
}

TEST(RecoverPose, TurnsBackWhereClothHasNoClearanceOnThePath)
{
    const Dressing d = person();
    const GarmentMesh loose = trousers(0.02);
    Pose crossed;
    crossed.rotations[lfemur] = Eigen::Quaterniond(Eigen::AngleAxisd(-50 * k_degree, Vec3::UnitZ()));
    crossed.rotations[rfemur] = crossed.rotations[lfemur].inverse();
    const RecoverResult result = recover_pose(d.rig, d.body, wearing(loose), crossed);
    EXPECT_FALSE(result.certified);
    EXPECT_LT(result.pose_reached, 1);
    ASSERT_FALSE(result.held_back.empty());
    EXPECT_GT(result.held_back[0].distance, 0.05);
    EXPECT_TRUE(result.garments[0].certificate.clean());
    EXPECT_LT(result.garments[0].certificate.strain.p95, 0.1) << "the cloth was torn";
    const Pose last = slerp(Pose(), crossed, result.pose_reached);
    const Positions posed = skin(d.body.surface.positions, d.rig.weights, bone_transforms(d.rig.skeleton, last));
    EXPECT_LT((result.body - posed).rowwise().norm().maxCoeff(), 1e-3);
}

/// Thighs turned towards each other by an angle.
Pose with_legs_together(double degrees)
{
    Pose pose;
    pose.rotations[lfemur] = Eigen::Quaterniond(Eigen::AngleAxisd(-degrees * k_degree, Vec3::UnitZ()));
    pose.rotations[rfemur] = pose.rotations[lfemur].inverse();
    return pose;
}

TEST(RecoverPose, SkinOfABodyThatCrossesItselfGivesWayAsFarAsItMay)
{
    const Dressing d = person();
    const DressedBody start = wearing(trousers(0.02));
    const Pose crossing = with_legs_together(10);
    RecoverOptions options;
    options.press = 0.01;
    const RecoverResult held = recover_pose(d.rig, d.body, start, crossing, options);
    EXPECT_FALSE(held.certified);
    EXPECT_EQ(held.pose_reached, 1);
    ASSERT_FALSE(held.held_back.empty());
    EXPECT_GT(held.held_back[0].distance, options.press);
    ASSERT_FALSE(held.overlaps.empty());

    options.press = 0.05;
    const RecoverResult pressed = recover_pose(d.rig, d.body, start, crossing, options);
    EXPECT_TRUE(pressed.certified);
    EXPECT_TRUE(pressed.residual->is_at_rest());
    EXPECT_TRUE(pressed.garments[0].certificate.clean());
    ASSERT_FALSE(pressed.held_back.empty());
    EXPECT_LE(pressed.held_back[0].distance, options.press);
    const Positions own = skin(d.body.surface.positions, d.rig.weights, bone_transforms(d.rig.skeleton, crossing));
    const Eigen::ArrayXd moved = (pressed.body - own).rowwise().norm();
    EXPECT_NEAR(moved.maxCoeff(), pressed.held_back[0].distance, 1e-12);
    EXPECT_LT((moved > 0).count(), moved.size() / 4) << "only between the legs";
}

TEST(RecoverPose, BridgesCreasesOtherwiseWhereSkinEndsFarFromItsPlace)
{
    const Dressing d = person();
    const RecoverOptions options { .quality = Quality::draft, .press = 0.05 };
    const RecoverResult result = recover_pose(d.rig, d.body, wearing(trousers(0.02)), with_legs_together(11), options);
    EXPECT_TRUE(result.certified) << result.held_back.at(0).distance;  // 0.48 m with the lower ends alone
}

// Each was refused once, or got stuck on its path.
struct Wearing {
    const char *name, *body, *garment;
};

class RealGarment : public testing::TestWithParam<Wearing> { };

TEST_P(RealGarment, IsPutOnAndStaysOn)
{
    const MeshFile body_file = MeshFile::read(GARMENTFIT_BODIES "/" + std::string(GetParam().body) + ".ply"),
                   cloth = MeshFile::read(GARMENTFIT_SAMPLES "/" + std::string(GetParam().garment) + ".ply");
    const BodyMesh body = make_body(body_file.positions(), body_file.triangles());
    const Rig rig = rig_body(body);
    const GarmentMesh garment = make_garment(cloth.positions(), cloth.triangles());
    const Pose fitted = fit_skeleton(rig, garment).pose;
    const DrapeResult draped = drape_garment(rig, body, { fitted }, garment, short_settling());
    ASSERT_EQ(draped.scale_reached, 1);
    RecoverOptions options;
    options.settling_steps = 10;
    EXPECT_TRUE(recover_pose(rig, body, draped, Pose(), options).certified);
}

INSTANTIATE_TEST_SUITE_P(Known, RealGarment,
                         testing::Values(Wearing { "HemNearAnElbow", "child_a_pose", "tshirt" },
                                         Wearing { "NecklineNearAShoulder", "tall_man_fighting", "tshirt" },
                                         Wearing { "FeetInTrouserLegs", "man_a_pose", "trousers" },
                                         Wearing { "WaistInALap", "old_woman_sitting", "trousers" }),
                         [](const auto& wearing) { return std::string(wearing.param.name); });

TEST(RecoverPose, EndsCleanOnThePathWhenTimeRunsOut)
{
    const Dressing d = person();
    Pose striding;
    striding.rotations[lfemur] = Eigen::Quaterniond(Eigen::AngleAxisd(30 * k_degree, Vec3::UnitX()));
    const RecoverResult result = recover_pose(d.rig, d.body, wearing(trousers(0.02)), striding, {}, late_at(0.4));
    EXPECT_TRUE(result.out_of_time);
    EXPECT_FALSE(result.certified);
    EXPECT_LT(result.pose_reached, 1);
    EXPECT_TRUE(result.garments[0].certificate.clean());
    EXPECT_TRUE(result.held_back.empty());
}

TEST(RecoverPose, RefusesGarmentsThatCrossTheBody)
{
    const Dressing d = person();
    const GarmentMesh tight = trousers(-0.01);
    EXPECT_THROW(recover_pose(d.rig, d.body, wearing(tight), Pose()), InvalidInput);
}

TEST(RecoverPose, StopsWhenToldTo)
{
    const Dressing d = person();
    const GarmentMesh loose = trousers(0.02);
    const Progress stop([](double, std::string_view) { return false; });
    EXPECT_THROW(recover_pose(d.rig, d.body, wearing(loose), Pose(), {}, stop), Cancelled);
}

/// The same person with three vertices of its own for each triangle, as files with hard edges have them.
Dressing in_loose_triangles(const Dressing& whole)
{
    const TriangleMesh& given = whole.body.surface;
    const std::vector<int> corners(given.triangles.data(), given.triangles.data() + given.triangles.size());
    Triangles own(given.triangles.rows(), 3);
    for (Eigen::Index k = 0; k < own.size(); ++k)
        own.data()[k] = int(k);
    Dressing result = whole;
    result.body.surface = { given.positions(corners, Eigen::all), own };
    result.body.repaired = true;
    result.rig.weights.bones = whole.rig.weights.bones(corners, Eigen::all).eval();
    result.rig.weights.weights = whole.rig.weights.weights(corners, Eigen::all).eval();
    return result;
}

/// Whether vertices that are one in the whole body are at one place.
bool is_in_one_piece(const Positions& loose, const BodyMesh& whole)
{
    Positions place = Positions::Constant(whole.surface.positions.rows(), 3, NAN);
    for (Eigen::Index k = 0; k < whole.surface.triangles.size(); ++k) {
        const int v = whole.surface.triangles.data()[k];
        if (std::isnan(place(v, 0)))
            place.row(v) = loose.row(k);
        if (place.row(v) != loose.row(k))
            return false;
    }
    return true;
}

TEST(DrapeGarment, SkinDoesNotTearWhereVerticesAreDoubled)
{
    const Dressing whole = person(20), loose = in_loose_triangles(whole);
    const GarmentMesh narrow = trousers(-0.015);  // holds the skin back
    const DrapeResult held = drape_garment(loose.rig, loose.body, { standing_pose(20) }, narrow, short_settling());
    EXPECT_LT(held.scale_reached, 1);
    EXPECT_TRUE(is_in_one_piece(held.body, whole.body));

    const DrapeResult draped
        = drape_garment(loose.rig, loose.body, { standing_pose(20) }, trousers(0.005), short_settling());
    const RecoverResult back = recover_pose(loose.rig, loose.body, draped, {}, { .quality = Quality::draft });
    EXPECT_TRUE(is_in_one_piece(draped.body, whole.body));
    EXPECT_EQ(back.body, loose.body.surface.positions) << "to the bit, where nothing is held back";
    EXPECT_TRUE(back.certified);
}

}  // namespace
