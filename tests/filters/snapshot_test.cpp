// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/filters/snapshot.h"

#include <gtest/gtest.h>

#include "fixtures.h"

namespace garmentfit {
namespace {

using namespace fixtures;

/// A person with a sheet beside it, which is dressed in it on paper only.
struct Snapshots : testing::Test {
    Snapshots()
    {
        const Person person = capsule_person();
        scene.body = make_body(person.mesh.positions, person.mesh.triangles);
        scene.rig = simple_rig(person);
        const TriangleMesh cloth = sheet(4, 0.05, [](double, double) { return 3.0; });
        scene.garments.push_back({ make_garment(cloth.positions, cloth.triangles), {} });
    }

    const Positions& worn() const { return scene.garments[0].mesh.positions; }

    void recover_in_two_frames()
    {
        scene.fits.push_back({});
        scene.draped = dressing_from(scene, {}, scene.body->surface.positions, { worn() }, { "sheet" });
        scene.recovered = scene.draped;
        scene.recovered->maps.resize(1);
        const Positions& body = scene.body->surface.positions;
        scene.recovered->frames = { { 0, body.array() + 1, { worn() } }, { 1, body, { worn() } } };
    }

    Scene scene;
};

TEST_F(Snapshots, BeginWithTheBodyInTheInputPoseBitForBit)
{
    const Snapshot now = snapshot_of(scene, 1, {});
    EXPECT_EQ(now.body, scene.body->surface.positions);
    EXPECT_TRUE(now.garments.empty());
}

TEST_F(Snapshots, ShowTheNearestFrameAndTheEndAfterIt)
{
    recover_in_two_frames();
    const Positions& input = scene.body->surface.positions;
    EXPECT_EQ(snapshot_of(scene, 0.4, {}).body, Positions(input.array() + 1));
    EXPECT_EQ(snapshot_of(scene, 0.6, {}).body, input);
    EXPECT_EQ(snapshot_of(scene, 1, {}).body, input);
    EXPECT_EQ(snapshot_of(scene, 0.4, {}).maps[0].ease.size(), worn().rows());
}

TEST_F(Snapshots, OfAFittedBodyShowTheFitsPose)
{
    scene.fits.push_back({});
    scene.fits[0].pose.root_translation = { 0, 0.25, 0 };
    const Positions moved = snapshot_of(scene, 1, {}).body;
    EXPECT_NEAR((moved - scene.body->surface.positions).col(1).minCoeff(), 0.25, 1e-12);
}

TEST_F(Snapshots, GoOnFromGarmentsAsTheyAreWornIfTheyAreTheSame)
{
    const Positions& input = scene.body->surface.positions;
    const Dressing dressing = dressing_from(scene, {}, input, { worn() }, { "sheet" });
    EXPECT_TRUE(dressing.certified);
    EXPECT_EQ(dressing.body, input);
    expect_invalid([&] { dressing_from(scene, {}, input, { worn().topRows(3) }, { "sheet" }); }, "sheet");
    expect_invalid([&] { dressing_from(scene, {}, input.topRows(3), { worn() }, { "sheet" }); }, "the body");
}

TEST_F(Snapshots, GoOnWithTheOutermostGarmentWhereverItWasGiven)
{
    scene.garments.push_back(scene.garments[0]);
    const std::vector<Positions> both { worn(), worn() };
    const auto outermost_now = [&] {
        return dressing_from(scene, {}, scene.body->surface.positions, both, { "sheet", "cloth" }).outermost;
    };
    EXPECT_EQ(outermost_now(), 1u) << "nothing else known";
    scene.fits.resize(2);
    EXPECT_EQ(outermost_now(), 1u) << "as given where layers are the same";
    scene.fits[0].layer = 1;
    EXPECT_EQ(outermost_now(), 0u);
}

TEST_F(Snapshots, GoOnFromABodyThatClothHeldBack)
{
    const Positions& input = scene.body->surface.positions;
    Positions left = input.cast<float>().cast<double>();  // as a file keeps it
    left.row(1) += Eigen::RowVector3d(0, -0.005, 0);
    const Dressing dressing = dressing_from(scene, {}, left, { worn() }, { "sheet" });
    EXPECT_EQ(dressing.body.row(1), left.row(1));
    EXPECT_EQ(dressing.body.row(0), input.row(0));
}

}  // namespace
}  // namespace garmentfit
