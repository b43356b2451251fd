// SPDX-License-Identifier: GPL-3.0-or-later
#include "coarse_body.h"

#include <random>

#include <gtest/gtest.h>

#include "fixtures.h"
#include "garmentfit/rig_body.h"
#include "rest_on_body.h"

namespace {

using namespace garmentfit;
using namespace garmentfit::fixtures;

struct Person {
    BodyMesh body;
    Rig rig;

    explicit Person(TriangleMesh mesh) : body { mesh, mesh }, rig(rig_body(body)) { }
};

TriangleMesh fine_mesh()
{
    PersonOptions options;
    options.arm_angle = 20;
    options.spacing = 0.008;
    return capsule_person(options).mesh;
}

/// With some 40,000 vertices.
const Person& fine_person()
{
    static const Person person(fine_mesh());
    return person;
}

GarmentMesh trousers()
{
    const TriangleMesh mesh = garment_round(
        person_skeleton({}), 0.02, [](const Vec3& p) { return p.y() > 0.2 && p.y() < 1.0 && std::abs(p.x()) < 0.26; });
    return make_garment(mesh.positions, mesh.triangles);
}

/// Thighs forward, arms down.
Pose bent_pose()
{
    Pose pose;
    for (const int thigh : { lfemur, rfemur })
        pose.rotations[thigh] = Eigen::Quaterniond(Eigen::AngleAxisd(-0.5, Vec3::UnitX()));
    pose.rotations[lhumerus] = Eigen::Quaterniond(Eigen::AngleAxisd(-0.6, Vec3::UnitZ()));
    pose.root_translation = Vec3(0.1, 0.2, 0.3);
    return pose;
}

double largest_distance(const Positions& a, const Positions& b) { return (a - b).rowwise().norm().maxCoeff(); }

TEST(CoarseBody, OfFewVerticesStaysAsItIs)
{
    const Person person(capsule_person().mesh);
    EXPECT_FALSE(CoarseBody(person.rig, person.body).is_other());
}

// Files keep vertices that no face uses, and each face's own.
TEST(CoarseBody, OfMoreVerticesThanTrianglesNeedIsRead)
{
    Person person(capsule_person().mesh);
    const auto repeat_first = [](auto& rows) {
        const Eigen::Index used = rows.rows();
        rows.conservativeResize(used + 40000, rows.cols());
        rows.bottomRows(rows.rows() - used).rowwise() = rows.row(0).eval();
    };
    const Eigen::Index used = person.body.surface.positions.rows();
    repeat_first(person.body.surface.positions);
    repeat_first(person.rig.weights.bones);
    repeat_first(person.rig.weights.weights);
    const CoarseBody coarse(person.rig, person.body);
    ASSERT_TRUE(coarse.is_other());
    EXPECT_LE(coarse.body().surface.positions.rows(), used);
}

TEST(CoarseBody, WithDetailsEverywhereStaysAsItIs)
{
    Person person = fine_person();
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0, 2e-3);
    for (double& x : person.body.surface.positions.reshaped())
        x += noise(random);
    EXPECT_FALSE(CoarseBody(person.rig, person.body).is_other());
}

TEST(CoarseBody, HasSomeOfTheVerticesAndTheSameSurface)
{
    const auto& [body, rig] = fine_person();
    ASSERT_GT(body.surface.positions.rows(), 35000);
    const CoarseBody coarse(rig, body);
    ASSERT_TRUE(coarse.is_other());
    const Positions& positions = coarse.body().surface.positions;
    EXPECT_LT(positions.rows(), body.surface.positions.rows() / 2);
    EXPECT_EQ(coarse.rig().weights.bones.rows(), positions.rows());
    EXPECT_EQ(coarse.gather({ .body = body.surface.positions }).body, positions);
    EXPECT_EQ(coarse.spread(positions), body.surface.positions);
    EXPECT_LT(largest_distance(coarse.lay(positions), body.surface.positions), 1.5e-3);
}

TEST(CoarseBody, TakesTheOthersAlong)
{
    const auto& [body, rig] = fine_person();
    const CoarseBody coarse(rig, body);
    const BoneTransforms transforms = bone_transforms(rig.skeleton, bent_pose());
    const Positions moved = skin(coarse.body().surface.positions, coarse.rig().weights, transforms),
                    all = coarse.spread(moved);
    EXPECT_EQ(coarse.gather({ .body = all }).body, moved);
    const Positions posed = skin(body.surface.positions, rig.weights, transforms);
    EXPECT_LT((all - posed).rowwise().norm().mean(), 2e-4);  // weights jump between arm and flank
    EXPECT_LT(largest_distance(coarse.lay(moved), all), 1.5e-3);
}

/// Three points midway between the vertex that is furthest off the coarse surface and that.
WornGarment speck_under_skin(const CoarseBody& coarse, const Positions& given)
{
    const Positions laid = coarse.lay(coarse.body().surface.positions);
    Eigen::Index v;
    (given - laid).rowwise().squaredNorm().maxCoeff(&v);
    const Vec3 off = (given.row(v) - laid.row(v)).transpose(), across = 0.02 * off.unitOrthogonal() * off.norm();
    GarmentMesh speck { Positions(3, 3), Triangles(1, 3) };
    for (int k = 0; k < 3; ++k)
        speck.positions.row(k)
            = laid.row(v) + (0.5 * off + Eigen::AngleAxisd(2 * k, off.normalized()) * across).transpose();
    speck.triangles << 0, 1, 2;
    return { .rest = speck, .positions = speck.positions };
}

TEST(CoarseBody, IsLaidUnderWhatItsOwnSkinWouldCross)
{
    const auto& [body, rig] = fine_person();
    const CoarseBody coarse(rig, body);
    const WornGarment speck = speck_under_skin(coarse, body.surface.positions);
    DressedBody dressed { .body = coarse.body().surface.positions, .garments = { speck } };
    ASSERT_TRUE(are_clear_of(coarse, dressed));
    EXPECT_FALSE(put_on_given(coarse, body.surface.triangles, dressed));
    EXPECT_EQ(dressed.body, coarse.lay(coarse.body().surface.positions));
    EXPECT_TRUE(dressed.garments[0].certificate.clean());

    const GarmentMesh wide = trousers();
    DressedBody other { .body = coarse.body().surface.positions, .garments = { { wide, wide.positions } } };
    EXPECT_TRUE(put_on_given(coarse, body.surface.triangles, other));
    EXPECT_EQ(other.body, body.surface.positions);
}

TEST(CoarseBody, GoesFromWhereItIsLaidToItsOwnSkin)
{
    const auto& [body, rig] = fine_person();
    const CoarseBody coarse(rig, body);
    const GarmentMesh wide = trousers();
    const DressedBody laid { .body = coarse.lay(coarse.body().surface.positions),
                             .garments = { { wide, wide.positions } } };
    ASSERT_NE(laid.body, body.surface.positions);
    RecoverOptions options;
    options.quality = Quality::draft;
    const RecoverResult result = rest_on_body(rig, body, laid, options, {});
    EXPECT_TRUE(result.certified);
    EXPECT_EQ(result.body, body.surface.positions);
}

TEST(Slow, FineBodiesWearWhatIsCertifiedOnThem)
{
    const auto& [body, rig] = fine_person();
    const DrapeResult draped = drape_garment(rig, body, {}, trousers());
    ASSERT_TRUE(draped.certified);
    EXPECT_EQ(draped.body, body.surface.positions);
    RecoverOptions options;
    options.frames = 3;
    options.quality = Quality::draft;
    options.step_length = 0.05;
    const RecoverResult bent = recover_pose(rig, body, draped, bent_pose(), options);
    ASSERT_TRUE(bent.certified);
    ASSERT_EQ(bent.frames.size(), 3u);
    options.frames = 0;
    options.quality = Quality::standard;
    const RecoverResult back = recover_pose(rig, body, bent, Pose(), options);
    EXPECT_TRUE(back.certified);
    EXPECT_EQ(back.body, body.surface.positions);
    EXPECT_TRUE(back.residual->is_at_rest());
    EXPECT_EQ(crossing_count({ back.garments[0].positions, back.garments[0].rest.triangles }, body.surface), 0);
}

}  // namespace
