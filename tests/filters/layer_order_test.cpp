// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "fixtures.h"
#include "garmentfit/filters/filters.h"
#include "garmentfit/filters/outcome.h"
#include "garmentfit/filters/warnings.h"
#include "garmentfit/layer_order.h"

namespace garmentfit {
namespace {

const std::vector<std::string> k_names { "first", "second" };

/// Trousers round a standing person, as far off the skin as that, metres.
GarmentInput trousers(double ease)
{
    const TriangleMesh mesh = fixtures::garment_round(fixtures::person_skeleton({}), ease, [](const Vec3& p) {
        return p.y() > 0.15 && p.y() < 1.0 && std::abs(p.x()) < 0.26;
    });
    return { make_garment(mesh.positions, mesh.triangles), GarmentType::trousers };
}

/// A person whose input pose is that of all the garments.
Scene scene_with(const std::vector<GarmentInput>& garments)
{
    fixtures::PersonOptions options;
    options.arm_angle = 20;
    const fixtures::Person person = fixtures::capsule_person(options);
    Scene scene;
    scene.body = make_body(person.mesh.positions, person.mesh.triangles);
    scene.rig = rig_body(*scene.body);
    scene.garments = garments;
    scene.fits.resize(garments.size());
    for (std::size_t i = 0; i < garments.size(); ++i)
        scene.fits[i].layer = int(i);
    return scene;
}

std::vector<int> found(const std::vector<double>& eases)
{
    std::vector<GarmentInput> garments;
    for (const double ease : eases)
        garments.push_back(trousers(ease));
    const Scene scene = scene_with(garments);
    std::vector<GarmentMesh> meshes;
    for (const GarmentInput& garment : garments)
        meshes.push_back(garment.mesh);
    return order_layers(*scene.rig, scene.body->surface.positions, meshes, scene.fits);
}

Parameters short_settling()
{
    Parameters parameters;
    parameters.drape.settling_steps = parameters.recover.settling_steps = 10;
    parameters.recover.quality = Quality::draft;
    return parameters;
}

TEST(LayerOrder, TheWiderGoesOverTheNarrower)
{
    EXPECT_EQ(found({ 0.06, 0.012, 0.03 }), (std::vector<int> { 2, 0, 1 }));
}

TEST(LayerOrder, WhatIsAsWideStaysAsItWasGiven)
{
    EXPECT_EQ(found({ 0.021, 0.02, 0.0205 }), (std::vector<int> { 0, 1, 2 }));
    EXPECT_EQ(found({ 0.04, 0.012, 0.0121 }), (std::vector<int> { 2, 0, 1 }));
}

TEST(LayerOrder, ACoatGoesOverAShirtThatIsWider)
{
    Scene scene = scene_with({ trousers(0.012), trousers(0.04) });
    const auto found = [&](GarmentType first, GarmentType second) {
        scene.fits[0].type = first;
        scene.fits[1].type = second;
        return order_layers(*scene.rig, scene.body->surface.positions,
                            { scene.garments[0].mesh, scene.garments[1].mesh }, scene.fits);
    };
    EXPECT_EQ(found(GarmentType::coat, GarmentType::blouse), (std::vector<int> { 1, 0 }));
    EXPECT_EQ(found(GarmentType::jacket, GarmentType::hoodie), (std::vector<int> { 1, 0 }));
    EXPECT_EQ(found(GarmentType::blouse, GarmentType::tshirt), (std::vector<int> { 0, 1 }));
    EXPECT_EQ(found(GarmentType::cape, GarmentType::jacket), (std::vector<int> { 1, 0 }));
    EXPECT_EQ(found(GarmentType::overalls, GarmentType::tanktop), (std::vector<int> { 1, 0 }));
}

TEST(LayerOrder, FittingFindsItWhereAskedToAndElseOnlyWarns)
{
    Scene scene = scene_with({ trousers(0.05), trousers(0.015) });
    filter_of("fit").run(scene, {});
    EXPECT_EQ(scene.fits[0].layer, 0);
    EXPECT_EQ(scene.fits[1].layer, 1);
    const auto warns = [&] {
        const std::vector<std::string> warnings = warnings_about_scene(scene, k_names, set_by_name);
        return std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
            return warning.find("from the inside out: second, first; give them in this order, or set layer_order auto")
                != std::string::npos;
        });
    };
    EXPECT_TRUE(warns());
    Parameters parameters;
    parameters.layer_order = LayerOrder::automatic;
    filter_of("fit").run(scene, parameters);
    EXPECT_EQ(scene.fits[0].layer, 1);
    EXPECT_EQ(scene.fits[1].layer, 0);
    EXPECT_FALSE(warns());
}

TEST(LayerOrder, DrapingFollowsTheLayersAndHandsOutInTheOrderGiven)
{
    Scene scene = scene_with({ trousers(0.05), trousers(0.015) });
    scene.fits[0].layer = 1;
    scene.fits[1].layer = 0;
    filter_of("drape").run(scene, short_settling());
    const Dressing& draped = *scene.draped;
    ASSERT_TRUE(draped.certified);
    EXPECT_EQ(draped.outermost, 0u);
    const auto mean_ease = [&](int i) { return draped.maps[i].ease.mean(); };
    EXPECT_EQ(draped.garments[0].rest.positions, scene.garments[0].mesh.positions);
    EXPECT_GT(mean_ease(0), mean_ease(1) + 0.01);

    Scene swapped = scene_with({ scene.garments[1], scene.garments[0] });
    filter_of("drape").run(swapped, short_settling());
    EXPECT_EQ(swapped.draped->garments[1].positions, draped.garments[0].positions);

    filter_of("recover").run(scene, short_settling());
    ASSERT_TRUE(scene.recovered->certified);
    EXPECT_EQ(scene.recovered->outermost, 0u);
    EXPECT_EQ(scene.recovered->garments[0].rest.positions, scene.garments[0].mesh.positions);
}

TEST(Draping, AGarmentWithoutAUnitIsMadeLargerWhereItIsTooSmall)
{
    Scene scene = scene_with({ trousers(-0.014) });
    filter_of("drape").run(scene, short_settling());
    EXPECT_EQ(outcome_of(*scene.draped), Outcome::too_small);

    scene.garments[0].has_unit = false;
    filter_of("drape").run(scene, short_settling());
    ASSERT_TRUE(scene.draped->certified);
    EXPECT_GT(scene.draped->garments[0].size, 1.01);
    const std::vector<std::string> warnings = warnings_about_dressing(*scene.draped, { "first" });
    EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(),
                            [](const std::string& line) { return line.find("% larger") != std::string::npos; }));
}

TEST(LayerOrder, WhatDoesNotGoOverTheOthersIsLeftOutUnderItsOwnName)
{
    Scene scene = scene_with({ trousers(-0.03), trousers(0.015) });
    scene.fits[0].layer = 1;
    scene.fits[1].layer = 0;
    filter_of("drape").run(scene, short_settling());
    const Dressing& draped = *scene.draped;
    EXPECT_EQ(outcome_of(draped), Outcome::too_small);
    EXPECT_EQ(draped.worn(), (std::vector<std::size_t> { 1 }));
    ASSERT_FALSE(draped.too_tight.empty());
    EXPECT_EQ(draped.too_tight[0].garment, 0);
    EXPECT_EQ(explain(draped, k_names).find("first is too small"), 0u) << explain(draped, k_names);
    EXPECT_GT(draped.maps[1].ease.size(), 0);
    EXPECT_TRUE(draped.garments[1].certificate.clean());
}

}  // namespace
}  // namespace garmentfit
