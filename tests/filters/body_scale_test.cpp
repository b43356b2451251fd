// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/filters/body_scale.h"

#include <cmath>

#include <gtest/gtest.h>

#include "fixtures.h"
#include "garmentfit/io.h"

namespace garmentfit {
namespace {

// The bodies are a power of ten apart, so all of them are dressed at one size. What remains is the rounding of p * 10 /
// 10. Joints differ by no more. Cloth does: contact and stopping rules enlarge roundings, and folds of a wide skirt may
// settle some millimetres elsewhere.
constexpr double k_same_joint = 1e-6;  // body metres
constexpr double k_same_cloth = 2e-3;  // body metres, root mean square over the vertices
constexpr double k_same_vertex = 2e-2;  // body metres, of any vertex

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

void expect_same_dressing(const Dressing& a, const Dressing& b, double size)
{
    EXPECT_TRUE(b.certified);
    EXPECT_LT(largest_distance(a.body, b.body / size), k_same_cloth);
    EXPECT_LT(mean_distance(a.garments[0].positions, b.garments[0].positions / size), k_same_cloth);
    EXPECT_LT(largest_distance(a.garments[0].positions, b.garments[0].positions / size), k_same_vertex);
    EXPECT_NEAR(a.garments[0].certificate.min_distance, b.garments[0].certificate.min_distance / size, k_same_cloth);
    EXPECT_LT((a.maps[0].ease - b.maps[0].ease / size).cwiseAbs().mean(), k_same_cloth);
    ASSERT_EQ(a.girths[0].size(), b.girths[0].size());
    for (std::size_t i = 0; i < a.girths[0].size(); ++i)
        EXPECT_NEAR(a.girths[0][i].body, b.girths[0][i].body / size, k_same_cloth) << a.girths[0][i].place;
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
        const Scene scene = dressed(size);
        EXPECT_LT(largest_distance(joints_of(human.rig->skeleton), joints_of(scene.rig->skeleton) / size),
                  k_same_joint);
        EXPECT_LT(largest_distance(fitted_joints(human), fitted_joints(scene) / size), k_same_joint);
        EXPECT_EQ(human.fits[0].type, scene.fits[0].type);
        ASSERT_TRUE(scene.draped && scene.recovered);
        expect_same_dressing(*human.draped, *scene.draped, size);
        expect_same_dressing(*human.recovered, *scene.recovered, size);
        EXPECT_EQ(scene.recovered->body, scene.body->surface.positions) << "the input's own vertices, bit for bit";
        EXPECT_EQ(scene.recovered->garments[0].rest.positions, scene.garments[0].mesh.positions);
    }
}

TEST(Slow, EachStepByItselfDressesADoll)
{
    Scene whole = dressed(0.1), scene = scene_of(0.1);
    for (const char* filter : { "rig", "fit", "drape", "recover" })
        filter_of(filter).run(scene, {});
    ASSERT_TRUE(scene.recovered);
    EXPECT_LT(largest_distance(fitted_joints(whole), fitted_joints(scene)), 0.1 * k_same_joint);
    EXPECT_TRUE(scene.recovered->certified);
    EXPECT_LT(mean_distance(whole.recovered->garments[0].positions, scene.recovered->garments[0].positions),
              0.1 * k_same_cloth);
    EXPECT_NEAR(scene.recovered->to_human_size, 10, 1e-12);
}

}  // namespace
}  // namespace garmentfit
