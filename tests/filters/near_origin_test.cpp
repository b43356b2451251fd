// SPDX-License-Identifier: GPL-3.0-or-later
#include "near_origin.h"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "fixtures.h"
#include "garmentfit/filters/body_scale.h"
#include "garmentfit/io.h"

namespace garmentfit {
namespace {

const Vec3 k_near = Vec3::Zero(), k_away(8e6, 0, -3e6);  // m
// unit: coordinates of that size are multiples of it; m
constexpr double k_last_digit = 1.0 / (1 << 29);
// derived: coordinates of the body are rounded once, which folds of cloth enlarge to millimetres, as in body_scale_test;
// root mean square, m
constexpr double k_other_folds = 0.015;
// derived: this test. Garment and body lie to each other as no garment of a near scene does, which the search for the
// pose begins with; root mean square, m
constexpr double k_other_pose = 0.05;

/// A sample; at each place its coordinates are multiples of the last digit.
TriangleMesh sample(const std::string& name, const Vec3& place)
{
    const MeshFile file = MeshFile::read(GARMENTFIT_SAMPLES "/" + name);
    Positions positions = (file.positions() / k_last_digit).array().round() * k_last_digit;
    positions.rowwise() += place.transpose();
    return { positions, file.triangles() };
}

Scene scene_at(const Vec3& body, const Vec3& garment)
{
    const TriangleMesh woman = sample("walking_woman.ply", body), skirt = sample("skirt.ply", garment);
    Scene scene;
    scene.body = make_body(woman.positions, woman.triangles);
    scene.garments = { { make_garment(skirt.positions, skirt.triangles), GarmentType::automatic, "skirt.ply" } };
    return scene;
}

double mean_distance(const Positions& a, const Positions& b, const Vec3& place)
{
    return std::sqrt((b.rowwise() - place.transpose() - a).rowwise().squaredNorm().mean());
}

Positions joints_of(const Skeleton& skeleton)
{
    Positions joints(int(bone_count), 3);
    for (int b = 0; b < bone_count; ++b)
        joints.row(b) = skeleton.tails[b];
    return joints;
}

Parameters draft()
{
    Parameters parameters;
    parameters.recover.quality = Quality::draft;
    parameters.recover.frames = 3;
    return parameters;
}

/// Certified where it lies, with body and rest shape as they were given.
void expect_dressed(const Scene& scene)
{
    ASSERT_TRUE(scene.recovered);
    EXPECT_TRUE(scene.recovered->certified);
    EXPECT_EQ(scene.recovered->body, scene.body->surface.positions) << "the input's own vertices, bit for bit";
    EXPECT_EQ(scene.recovered->garments[0].rest.positions, scene.garments[0].mesh.positions);
    for (const Dressing* dressing : { &*scene.draped, &*scene.recovered }) {
        std::vector<WornGarment> worn = dressing->garments;
        EXPECT_TRUE(certify_all(worn, { dressing->body, scene.body->surface.triangles }));
        const Positions posed = skin(scene.body->surface.positions, scene.rig->weights,
                                     bone_transforms(scene.rig->skeleton, dressing->pose));
        EXPECT_LT(mean_distance(posed, dressing->body, k_near), 1e-3) << "pose and vertices are in one place";
    }
}

/// @param folds  how far cloth may be from that of the scene near the origin, m
void expect_moved(const Scene& near, const Scene& far, const Vec3& body, const Vec3& garment, double folds)
{
    EXPECT_LT(mean_distance(joints_of(near.rig->skeleton), joints_of(far.rig->skeleton), body), 1e-6);
    EXPECT_LT(mean_distance(near.draped->garments[0].positions, far.draped->garments[0].positions, garment), folds);
    EXPECT_LT(mean_distance(near.recovered->garments[0].positions, far.recovered->garments[0].positions, body), folds);
    const std::vector<RecoverFrame>& frames = far.recovered->frames;
    ASSERT_EQ(frames.size(), near.recovered->frames.size());
    EXPECT_LT(mean_distance(frames.front().body, far.draped->body, k_near), 1e-3) << "frames begin where draping ended";
    EXPECT_EQ(frames.back().body, far.recovered->body);
}

TEST(NearOrigin, LeavesWhatIsNearTheOriginWhereItIs)
{
    EXPECT_TRUE(origins_of(scene_at(k_near, k_near)).all_zero());
    EXPECT_TRUE(origins_of(scene_at({ 50, 0, -50 }, { -50, 0, 0 })).all_zero());
}

TEST(NearOrigin, MovingThereAndBackKeepsEachBit)
{
    for (const Vec3& away : { Vec3(1e3, 0, 0), Vec3(1e5, -1e5, 7), k_away, Vec3(0.1, 1e9, 0) }) {
        const Scene given = scene_at(away, away);
        const Origins origins = origins_of(given);
        const Scene moved = move_to_origin(given, origins);
        EXPECT_LT(moved.body->surface.positions.cwiseAbs().maxCoeff(), 10);
        const Positions positions = moved.body->surface.positions.rowwise() + origins.body.transpose();
        EXPECT_EQ(positions, given.body->surface.positions) << away.transpose();
        EXPECT_EQ(origins.garments[0], origins.body) << "body and garment stay together";
    }
}

TEST(NearOrigin, AGarmentFarFromTheBodyHasItsOwnOrigin)
{
    const Origins garment_away = origins_of(scene_at(k_near, k_away)), body_away = origins_of(scene_at(k_away, k_near));
    EXPECT_EQ(garment_away.body, k_near);
    EXPECT_LT((garment_away.garments[0] - k_away).norm(), 10);
    EXPECT_LT((body_away.body - k_away).norm(), 10);
    EXPECT_EQ(body_away.garments[0], k_near);
}

TEST(NearOrigin, SizeIsMeasuredFarAwayToo)
{
    const Scene near = scene_at(k_near, k_near), far = scene_at(k_away, k_away);
    EXPECT_NEAR(stature_of(*far.body), stature_of(*near.body), 1e-6);
    EXPECT_EQ(factor_to_human_size(*far.body), 1);
}

TEST(NearOrigin, ErrorsSayWhereTheirPlacesAreSeenFrom)
{
    TriangleMesh ball = fixtures::polygonise([](const Vec3& p) { return p.norm() - 0.5; }, Vec3::Constant(-0.6),
                                             Vec3::Constant(0.6), 0.1);
    ball.positions.rowwise() += k_away.transpose();
    Scene scene;
    scene.body = make_body(ball.positions, ball.triangles);
    fixtures::expect_invalid([&] { filter_of("rig").run(scene, {}); }, "places as seen from 8000000, ");
}

TEST(Slow, BodiesAndClothesFarFromTheOriginAreDressed)
{
    Scene near = scene_at(k_near, k_near), far = scene_at(k_away, k_away);
    filter_of("dress").run(near, draft());
    filter_of("dress").run(far, draft());
    expect_dressed(far);
    expect_moved(near, far, k_away, k_away, k_other_folds);
}

TEST(Slow, EachStepByItselfDressesABodyFarFromItsGarment)
{
    Scene near = scene_at(k_near, k_near), far = scene_at(k_away, -k_away);
    filter_of("dress").run(near, draft());
    for (const char* filter : { "rig", "fit", "drape", "recover" })
        filter_of(filter).run(far, draft());
    expect_dressed(far);
    expect_moved(near, far, k_away, -k_away, k_other_pose);
}

}  // namespace
}  // namespace garmentfit
