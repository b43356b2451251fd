// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/filters/body_scale.h"

#include <cmath>

#include <gtest/gtest.h>

#include "fixtures.h"
#include "garmentfit/io.h"

namespace garmentfit {
namespace {

/// How far dressings may be apart, body metres.
struct Tolerance {
    double mean;  ///< root mean square over the vertices of the cloth; also of lengths
    double vertex;  ///< of any vertex of the cloth
};

// unit: rounding of lengths that are scaled back
constexpr Tolerance k_rounding { 1e-9, 1e-9 };
// derived: this test. Doll and giant are a power of ten from the human, so all are dressed at one size, but for the
// rounding of p / 10 * 10. Contact and stopping rules enlarge that: folds of a wide skirt settle some millimetres
// elsewhere.
constexpr Tolerance k_other_folds { 0.015, 0.06 };
constexpr double k_same_joint
    = 1e-6;  // unit: rounding, which the search for joints and pose hardly enlarges; body metres

BodyMesh body_from(const std::string& path, double size)
{
    const MeshFile file = MeshFile::read(path);
    return make_body(size * file.positions(), file.triangles());
}

GarmentInput skirt_of(double size)
{
    const MeshFile file = MeshFile::read(GARMENTFIT_SAMPLES "/skirt.ply");
    return { make_garment(size * file.positions(), file.triangles()), GarmentType::automatic, "skirt.ply" };
}

Scene scene_of(double size)
{
    Scene scene;
    scene.body = body_from(GARMENTFIT_SAMPLES "/walking_woman.ply", size);
    scene.garments = { skirt_of(size) };
    return scene;
}

Scene dressed(double size)
{
    Scene scene = scene_of(size);
    filter_of("dress").run(scene, {});
    return scene;
}

double largest_distance(const Positions& a, const Positions& b) { return (a - b).rowwise().norm().maxCoeff(); }

double mean_distance(const Positions& a, const Positions& b)
{
    return std::sqrt((a - b).rowwise().squaredNorm().mean());
}

Positions joints_of(const Skeleton& skeleton)
{
    Positions joints(int(bone_count), 3);
    for (int b = 0; b < bone_count; ++b)
        joints.row(b) = skeleton.tails[b];
    return joints;
}

Positions fitted_joints(const Scene& scene)
{
    return joints_of(pose_skeleton(scene.rig->skeleton, scene.fits[0].pose));
}

void expect_same_dressing(const Dressing& a, const Dressing& b, double size, const Tolerance& tolerance)
{
    EXPECT_TRUE(b.certified);
    EXPECT_LT(largest_distance(a.body, b.body / size), tolerance.vertex);
    EXPECT_LT(mean_distance(a.garments[0].positions, b.garments[0].positions / size), tolerance.mean);
    EXPECT_LT(largest_distance(a.garments[0].positions, b.garments[0].positions / size), tolerance.vertex);
    EXPECT_NEAR(a.garments[0].certificate.min_distance, b.garments[0].certificate.min_distance / size, tolerance.mean);
    EXPECT_LT((a.maps[0].ease - b.maps[0].ease / size).cwiseAbs().mean(), tolerance.mean);
    ASSERT_GT(b.overstretches[0].longer, 0);
    EXPECT_NEAR(a.overstretches[0].longer, b.overstretches[0].longer / size, tolerance.vertex);
    ASSERT_EQ(a.girths[0].size(), b.girths[0].size());
    for (std::size_t i = 0; i < a.girths[0].size(); ++i)
        EXPECT_NEAR(a.girths[0][i].body, b.girths[0][i].body / size, tolerance.mean) << a.girths[0][i].place;
}

void expect_same_pose(const Scene& a, const Scene& b, double size)
{
    EXPECT_LT(largest_distance(joints_of(a.rig->skeleton), joints_of(b.rig->skeleton) / size), k_same_joint);
    EXPECT_LT(largest_distance(fitted_joints(a), fitted_joints(b) / size), k_same_joint);
    EXPECT_EQ(a.fits[0].type, b.fits[0].type);
}

/// What the filters work on: body and garment of that size, brought to the size of a human. Nothing else is scaled.
Scene dressed_twin(double size)
{
    Scene scene = scale_scene(scene_of(size), 1 / size);
    filter_of("dress").run(scene, {});
    return scene;
}

TEST(BodyScale, LeavesBodiesOfHumanSizeAsTheyAre)
{
    for (const char* body : { "child_a_pose", "heavy_man_arms_down", "man_a_pose", "muscular_man_hands_on_hips",
                              "old_woman_sitting", "tall_man_fighting", "woman_squatting", "woman_t_pose" })
        EXPECT_EQ(factor_to_human_size(body_from(std::string(GARMENTFIT_BODIES "/") + body + ".ply", 1)), 1) << body;
    EXPECT_EQ(factor_to_human_size(body_from(GARMENTFIT_SAMPLES "/walking_woman.ply", 1)), 1);
}

TEST(BodyScale, TakesDollsAndGiantsToTheSizeOfAHuman)
{
    const std::string man = GARMENTFIT_BODIES "/man_a_pose.ply";
    EXPECT_NEAR(factor_to_human_size(body_from(man, 0.1)), 10, 1e-12);
    EXPECT_NEAR(factor_to_human_size(body_from(man, 10)), 0.1, 1e-12);
    EXPECT_NEAR(factor_to_human_size(body_from(man, 0.01)), 100, 1e-12);
    for (const double size : { 0.15, 0.2, 2.2, 4., 40. }) {
        const double twice = factor_to_human_size(body_from(man, 2 * size)),
                     once = factor_to_human_size(body_from(man, size));
        EXPECT_GT(size * once, 0.5) << size;
        EXPECT_LT(size * once, 1.6) << size;
        EXPECT_LE(twice, once) << size;
    }
}

TEST(BodyScale, DoesNotDependOnPosture)
{
    for (const char* body : { "old_woman_sitting", "woman_squatting", "tall_man_fighting" })
        EXPECT_NEAR(factor_to_human_size(body_from(std::string(GARMENTFIT_BODIES "/") + body + ".ply", 0.1)), 10, 1e-12)
            << body;
}

TEST(BodyScale, ErrorsSayThatTheirLengthsAreThoseOfAHuman)
{
    const TriangleMesh ball = fixtures::polygonise([](const Vec3& p) { return p.norm() - 0.02; }, Vec3::Constant(-0.03),
                                                   Vec3::Constant(0.03), 0.004);
    Scene scene;
    scene.body = make_body(ball.positions, ball.triangles);
    fixtures::expect_invalid([&] { filter_of("rig").run(scene, {}); }, "lengths as on a body of human size");
}

TEST(Slow, ADollAndAGiantAreDressedAsAHumanIs)
{
    const Scene human = dressed(1);
    ASSERT_TRUE(human.recovered && human.recovered->certified);
    for (const double size : { 0.1, 10. }) {
        SCOPED_TRACE(size);
        const Scene scene = dressed(size), twin = dressed_twin(size);
        ASSERT_TRUE(scene.draped && scene.recovered && twin.recovered);
        expect_same_pose(twin, scene, size);
        expect_same_dressing(*twin.draped, *scene.draped, size, k_rounding);
        expect_same_dressing(*twin.recovered, *scene.recovered, size, k_rounding);
        expect_same_pose(human, scene, size);
        expect_same_dressing(*human.draped, *scene.draped, size, k_other_folds);
        expect_same_dressing(*human.recovered, *scene.recovered, size, k_other_folds);
        EXPECT_EQ(scene.recovered->body, scene.body->surface.positions) << "the input's own vertices, bit for bit";
        EXPECT_EQ(scene.recovered->garments[0].rest.positions, scene.garments[0].mesh.positions);
    }
}

TEST(Slow, EachStepByItselfDressesADoll)
{
    constexpr double size = 0.1;
    const Scene whole = dressed(size);
    Scene scene = scene_of(size);
    for (const char* filter : { "rig", "fit", "drape", "recover" })
        filter_of(filter).run(scene, {});
    ASSERT_TRUE(scene.recovered && scene.recovered->certified);
    EXPECT_LT(largest_distance(fitted_joints(whole), fitted_joints(scene)), size * k_same_joint);
    EXPECT_LT(mean_distance(whole.recovered->garments[0].positions, scene.recovered->garments[0].positions),
              size * k_other_folds.mean);
    EXPECT_NEAR(scene.recovered->to_human_size, 1 / size, 1e-12);
}

}  // namespace
}  // namespace garmentfit
