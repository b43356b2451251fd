// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/rig_body.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "fixtures.h"
#include "garmentfit/error.h"

namespace {

using namespace garmentfit;
using fixtures::capsule_person;
using fixtures::expect_invalid;
using fixtures::Person;
using fixtures::PersonOptions;
using fixtures::segment_distance;

constexpr double k_stature = 1.75;  // m, of the person at scale 1

BodyMesh body_of(const TriangleMesh& mesh) { return make_body(mesh.positions, mesh.triangles); }

TriangleMesh moved(const TriangleMesh& mesh, const Eigen::Isometry3d& motion)
{
    TriangleMesh result = mesh;
    for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v)
        result.positions.row(v) = motion * Vec3(mesh.positions.row(v));
    return result;
}

TriangleMesh mirrored(const TriangleMesh& mesh)
{
    TriangleMesh result = mesh;
    result.positions.col(0) *= -1;
    result.triangles.col(1).swap(result.triangles.col(2));
    return result;
}

double winding_number(const TriangleMesh& mesh, const Vec3& p)
{
    double angle = 0;
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
        Vec3 d[3];
        for (int k = 0; k < 3; ++k)
            d[k] = mesh.positions.row(mesh.triangles(f, k)).transpose() - p;
        const double l0 = d[0].norm(), l1 = d[1].norm(), l2 = d[2].norm();
        angle += 2
            * std::atan2(d[0].dot(d[1].cross(d[2])),
                         l0 * l1 * l2 + d[0].dot(d[1]) * l2 + d[1].dot(d[2]) * l0 + d[2].dot(d[0]) * l1);
    }
    return angle / (4 * std::acos(-1));
}

double weight_of(const SkinWeights& weights, Eigen::Index vertex, int bone)
{
    double sum = 0;
    for (int k = 0; k < 4; ++k)
        sum += weights.bones(vertex, k) == bone ? weights.weights(vertex, k) : 0;
    return sum;
}

/// A smaller proxy, for tests that do not depend on its size.
const RigOptions k_coarse { .proxy_vertices = 3500 };

class RigBodyInPose : public testing::TestWithParam<PersonOptions> { };

TEST_P(RigBodyInPose, FindsSidesAndJointsInsideTheBody)
{
    const Person person = capsule_person(GetParam());
    const Rig rig = rig_body(body_of(person.mesh));
    const double stature = k_stature * GetParam().scale;
    for (const int bone : { lhipjoint, lfemur, ltibia, lclavicle, lhumerus, lradius })
        for (const int side : { bone, mirror_of(bone) })
            EXPECT_LT((rig.skeleton.tail(side) - person.skeleton.tail(side)).norm(), 0.05 * stature) << bone_name(side);
    EXPECT_LT((rig.skeleton.tail(thorax) - person.skeleton.tail(thorax)).norm(), 0.07 * stature);
    for (int tip = 0; tip < extremity_count; ++tip)
        EXPECT_LT((rig.skeleton.tips[tip] - person.skeleton.tips[tip]).norm(), 0.05 * stature) << tip;

    EXPECT_GT(rig.up.y(), 0.95);
    EXPECT_GT(rig.front.z(), 0.95);
    EXPECT_GT(rig.side_confidence, 0.3);

    EXPECT_GT(winding_number(person.mesh, rig.skeleton.root), 0.5);
    for (int bone = 0; bone < bone_count; ++bone)
        EXPECT_GT(winding_number(person.mesh, rig.skeleton.tail(bone)), 0.5) << bone_name(bone);
}

INSTANTIATE_TEST_SUITE_P(Poses, RigBodyInPose,
                         testing::Values(PersonOptions {}, PersonOptions { .arm_angle = 0 },
                                         PersonOptions { .arm_angle = -60 },
                                         PersonOptions { .arm_angle = 30, .elbow_angle = 80 },
                                         PersonOptions { .knee_angle = 85, .hip_angle = 85 },
                                         PersonOptions { .scale = 0.6 }),
                         [](const auto& pose) { return "pose" + std::to_string(pose.index); });

TEST(RigBody, PlacesTheNeckAtTheShouldersWhereTheHeadIsLarge)
{
    TriangleMesh mesh = capsule_person().mesh;
    for (auto p : mesh.positions.rowwise())
        if (const double above = p.y() - 1.5; above > 0) {
            const double wider = 1 + std::min(1.0, 20 * above);
            p = Eigen::RowVector3d(wider * p.x(), 1.5 + 2.2 * above, wider * p.z());
        }
    const Skeleton skeleton = rig_body(body_of(mesh), k_coarse).skeleton;
    const double shoulders = 0.5 * (skeleton.head(lhumerus).y() + skeleton.head(rhumerus).y());
    EXPECT_LT(skeleton.head(lowerneck).y() - shoulders, 0.45 * (shoulders - skeleton.root.y()));
    EXPECT_GT(skeleton.head(lowerneck).y(), shoulders);
}

TEST(RigBody, GivesEveryVertexPositiveWeightsThatSumToOne)
{
    const Person person = capsule_person();
    const SkinWeights weights = rig_body(body_of(person.mesh), k_coarse).weights;
    ASSERT_EQ(weights.weights.rows(), person.mesh.positions.rows());
    EXPECT_GE(weights.weights.minCoeff(), 0);
    EXPECT_GE(weights.bones.minCoeff(), 0);
    EXPECT_LT(weights.bones.maxCoeff(), bone_count);
    EXPECT_LT((weights.weights.rowwise().sum().array() - 1).abs().maxCoeff(), 1e-12);
}

TEST(RigBody, WeightsASkinVertexToTheBoneBelowIt)
{
    const Person person = capsule_person();
    const Rig rig = rig_body(body_of(person.mesh));
    for (Eigen::Index v = 0; v < person.mesh.positions.rows(); ++v)
        for (const int bone : { lhumerus, rhumerus, lradius, rradius, lfemur, rfemur, ltibia, rtibia }) {
            const Vec3 p = person.mesh.positions.row(v);
            const Vec3 head = rig.skeleton.head(bone), axis = rig.skeleton.tail(bone) - head;
            const double t = (p - head).dot(axis) / axis.squaredNorm();
            if (t < 0.4 || t > 0.6 || (p - head - t * axis).norm() > 0.08)
                continue;
            EXPECT_GT(weight_of(rig.weights, v, bone), 0.65) << bone_name(bone) << " at vertex " << v;
        }
}

TEST(RigBody, WeightsVerticesOfIslands)
{
    Person person = capsule_person();
    const Vec3 head = person.skeleton.tips[head_top] + Vec3(0, -0.1, 0.05);
    const auto ball = [&](const Vec3& p) { return (p - head).norm() - 0.03; };
    const TriangleMesh eye = fixtures::polygonise(ball, head - Vec3::Constant(0.06), head + Vec3::Constant(0.06), 0.02);
    const TriangleMesh both = fixtures::joined(person.mesh, eye);
    const SkinWeights weights = rig_body(body_of(both), k_coarse).weights;
    ASSERT_EQ(weights.weights.rows(), both.positions.rows());
    for (Eigen::Index v = person.mesh.positions.rows(); v < both.positions.rows(); ++v)
        EXPECT_GT(weight_of(weights, v, upperneck) + weight_of(weights, v, lowerneck), 0.8);
}

TEST(RigBody, OfARotatedBodyIsTheRotatedRig)
{
    const Person person = capsule_person();
    Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
    motion.rotate(Eigen::AngleAxisd(2.1, Vec3(1, -2, 0.5).normalized()));
    motion.translation() = Vec3(3, -1, 2);
    const Rig rig = rig_body(body_of(person.mesh)), rotated = rig_body(body_of(moved(person.mesh, motion)));
    for (int bone = 0; bone < bone_count; ++bone)
        EXPECT_LT((motion * rig.skeleton.tail(bone) - rotated.skeleton.tail(bone)).norm(), 0.03 * k_stature)
            << bone_name(bone);
    EXPECT_GT((motion.linear() * rig.front).dot(rotated.front), 0.98);
    EXPECT_GT((motion.linear() * rig.up).dot(rotated.up), 0.98);
}

TEST(RigBody, OfAMirroredBodyIsTheMirroredRig)
{
    const Person person = capsule_person({ .arm_angle = 20 });
    Eigen::Isometry3d aside = Eigen::Isometry3d::Identity();
    aside.rotate(Eigen::AngleAxisd(0.3, Vec3::UnitZ()));
    const TriangleMesh mesh = moved(person.mesh, aside);
    const Rig rig = rig_body(body_of(mesh)), mirror = rig_body(body_of(mirrored(mesh)));
    const Eigen::DiagonalMatrix<double, 3> flip(-1, 1, 1);
    for (int bone = 0; bone < bone_count; ++bone)
        EXPECT_LT((flip * rig.skeleton.tail(bone) - mirror.skeleton.tail(mirror_of(bone))).norm(), 0.03 * k_stature)
            << bone_name(bone);
}

TEST(RigBody, OfAScaledBodyIsTheScaledRig)
{
    const TriangleMesh person = capsule_person().mesh;
    const Rig rig = rig_body(body_of(person));
    for (const double scale : { 0.4, 3.0 }) {
        const Rig scaled = rig_body(body_of({ scale * person.positions, person.triangles }));
        for (int bone = 0; bone < bone_count; ++bone)
            EXPECT_LT((scaled.skeleton.tail(bone) / scale - rig.skeleton.tail(bone)).norm(), 0.02 * k_stature)
                << bone_name(bone) << " at scale " << scale;
    }
}

TEST(RigBody, ExchangesSidesWhenAsked)
{
    const BodyMesh body = body_of(capsule_person().mesh);
    const Rig rig = rig_body(body, k_coarse),
              swapped = rig_body(body, { .proxy_vertices = k_coarse.proxy_vertices, .swap_sides = true });
    for (int bone = 0; bone < bone_count; ++bone)
        EXPECT_EQ(rig.skeleton.tail(bone), swapped.skeleton.tail(mirror_of(bone))) << bone_name(bone);
    EXPECT_EQ(rig.front, -swapped.front);
}

TEST(RigBody, TakesGivenJointsAndAdaptsThoseBetween)
{
    const BodyMesh body = body_of(capsule_person().mesh);
    const Rig found = rig_body(body, k_coarse);
    RigOptions options = k_coarse;
    const Vec3 wrist = found.skeleton.tail(lradius) + Vec3(0, 0, 0.04);
    options.joints.tails[lradius] = wrist;
    const Rig given = rig_body(body, options);
    EXPECT_LT((given.skeleton.tail(lradius) - wrist).norm(), 1e-9);
    const double elbow = given.skeleton.tail(lhumerus).z() - found.skeleton.tail(lhumerus).z();
    EXPECT_GT(elbow, 0.01);
    EXPECT_LT(elbow, 0.03);
    EXPECT_LT((given.skeleton.tail(rhumerus) - found.skeleton.tail(rhumerus)).norm(), 1e-9);
}

TEST(RigBody, SearchesNothingWhenEveryJointIsGiven)
{
    const Person person = capsule_person();
    RigOptions options;
    options.joints.root = person.skeleton.root;
    for (int b = 0; b < bone_count; ++b)
        options.joints.tails[b] = person.skeleton.tail(b);
    const Rig rig = rig_body(body_of(person.mesh), options);
    for (int b = 0; b < bone_count; ++b)
        EXPECT_LT((rig.skeleton.tail(b) - person.skeleton.tail(b)).norm(), 1e-9) << bone_name(b);
    EXPECT_GT(rig.front.z(), 0.95);
    EXPECT_EQ(rig.weights.weights.rows(), person.mesh.positions.rows());
}

TEST(RigBody, FacesTheGivenFront)
{
    const BodyMesh body = body_of(capsule_person().mesh);
    RigOptions options = k_coarse;
    options.front = -Vec3::UnitZ();
    const Rig rig = rig_body(body, options);
    EXPECT_LT(rig.front.z(), -0.95);
    EXPECT_LT(rig.skeleton.tail(lfemur).x(), 0);
    EXPECT_GT(rig.side_confidence, 0.95);
}

TEST(RigBody, IsAsGoodFarFromTheOrigin)
{
    const Person person = capsule_person();
    const Vec3 far(5e4, -2e3, 1e5);
    TriangleMesh away = person.mesh;
    away.positions.rowwise() += far.transpose();
    const Rig here = rig_body(body_of(person.mesh)), there = rig_body(body_of(away));
    for (int b = 0; b < bone_count; ++b)
        EXPECT_LT((there.skeleton.tail(b) - far - here.skeleton.tail(b)).norm(), 0.02 * k_stature) << bone_name(b);
}

/// The part of a person for which `keep` is true, with holes at the cuts.
TriangleMesh cut(const TriangleMesh& mesh, const std::function<bool(const Vec3&)>& keep)
{
    std::vector<int> rows;
    for (int f = 0; f < int(mesh.triangles.rows()); ++f)
        if (keep(mesh.positions(mesh.triangles.row(f), Eigen::all).colwise().mean().transpose()))
            rows.push_back(f);
    return { mesh.positions, mesh.triangles(rows, Eigen::all) };
}

TEST(RigBody, RigsABodyWithoutHead)
{
    const Person person = capsule_person();
    const double neck = person.skeleton.tail(thorax).y() + 0.03;
    const Rig rig = rig_body(body_of(cut(person.mesh, [&](const Vec3& p) { return p.y() < neck; })));
    for (const int bone : { lfemur, rfemur, ltibia, rtibia, lhumerus, rhumerus, lradius, rradius })
        EXPECT_LT((rig.skeleton.tail(bone) - person.skeleton.tail(bone)).norm(), 0.05 * k_stature) << bone_name(bone);
}

TEST(RigBody, SeparatesAHandFromTheHipThatItIsMergedWith)
{
    const Person person = capsule_person({ .arm_angle = 60, .elbow_angle = 15 });
    const auto bridge = [&](const Vec3& p) {  // from the left hand to the thigh beside it
        const Vec3 hand = person.skeleton.tips[lhand_tip];
        return segment_distance(p, hand, { 0.12, hand.y(), 0 }) - 0.035;
    };
    const auto both = [&](const Vec3& p) { return std::min(fixtures::person_distance(person.skeleton, p), bridge(p)); };
    const TriangleMesh merged = fixtures::polygonise(both, Vec3(-1.1, -0.2, -0.5), Vec3(1.1, 2.1, 0.5), 0.02);
    const Rig rig = rig_body(body_of(merged));
    for (const int bone : { lhumerus, rhumerus, lfemur, rfemur, ltibia, rtibia })
        EXPECT_LT((rig.skeleton.tail(bone) - person.skeleton.tail(bone)).norm(), 0.06 * k_stature) << bone_name(bone);
}

TEST(RigBody, RefusesTwoPeople)
{
    const TriangleMesh one = capsule_person().mesh;
    Eigen::Isometry3d aside = Eigen::Isometry3d::Identity();
    aside.translation() = Vec3(1.8, 0, 0);
    expect_invalid([&] { body_of(fixtures::joined(one, moved(one, aside))); },
                   "pieces that lie apart, the second 100% the size");
}

TEST(RigBody, DependsLittleOnTrianglesAndNotOnTheOrderOfVertices)
{
    const Person person = capsule_person();
    const Rig rig = rig_body(body_of(person.mesh));
    TriangleMesh rotated = person.mesh;  // vertices in reverse order
    rotated.positions = person.mesh.positions.colwise().reverse().eval();
    rotated.triangles = int(person.mesh.positions.rows()) - 1 - person.mesh.triangles.array();
    const TriangleMesh finer = capsule_person({ .spacing = 0.025 }).mesh,
                       coarser = capsule_person({ .spacing = 0.06 }).mesh;
    for (const TriangleMesh& mesh : { rotated, finer, coarser }) {
        const Rig other = rig_body(body_of(mesh));
        for (int b = 0; b < bone_count; ++b)
            EXPECT_LT((other.skeleton.tail(b) - rig.skeleton.tail(b)).norm(), 0.03 * k_stature) << bone_name(b);
    }
}

TEST(RigBody, GivesTheSameBitsTwice)
{
    const BodyMesh body = body_of(capsule_person().mesh);
    const Rig first = rig_body(body, k_coarse), second = rig_body(body, k_coarse);
    EXPECT_EQ(first.skeleton.tails, second.skeleton.tails);
    EXPECT_EQ(first.weights.weights, second.weights.weights);
    EXPECT_EQ(first.weights.bones, second.weights.bones);
}

TEST(RigBody, CanBeStoppedAndRunAgain)
{
    const BodyMesh body = body_of(capsule_person().mesh);
    for (const double when : { 0.1, 0.3, 0.75 })
        EXPECT_THROW(
            rig_body(body, k_coarse, Progress([&](double fraction, std::string_view) { return fraction < when; })),
            Cancelled);
    EXPECT_NO_THROW(rig_body(body, k_coarse));
}

TEST(RigBody, ReportsGrowingProgressUpToOne)
{
    double last = 0;
    rig_body(body_of(capsule_person().mesh), {}, Progress([&](double fraction, std::string_view) {
                 EXPECT_GE(fraction, last);
                 last = fraction;
                 return true;
             }));
    EXPECT_EQ(last, 1);
}

TriangleMesh shape(const std::function<double(const Vec3&)>& distance)
{
    return fixtures::polygonise(distance, Vec3::Constant(-1.1), Vec3::Constant(1.1), 0.08);
}

TEST(RigBody, RefusesBallsAndCubesAsBlocks)
{
    for (const TriangleMesh& block : { shape([](const Vec3& p) { return p.norm() - 0.5; }),
                                       shape([](const Vec3& p) { return p.cwiseAbs().maxCoeff() - 0.5; }) })
        expect_invalid([&] { rig_body(body_of(block)); }, "isoperimetric quotient");
}

TEST(RigBody, RefusesATetrahedron)
{
    const Positions corners = (Positions(4, 3) << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1).finished();
    const Triangles faces = (Triangles(4, 3) << 0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2).finished();
    EXPECT_THROW(rig_body(make_body(corners, faces)), InvalidInput);
}

TEST(RigBody, NamesTheNumberOfEndsFound)
{
    const TriangleMesh rod = shape([](const Vec3& p) {
        return segment_distance(p, { 0, -0.9, 0 }, { 0, 0.9, 0 }) - 0.1;
    });
    expect_invalid([&] { rig_body(body_of(rod)); }, "2 ends found, a human has 5");
}

TEST(RigBody, RefusesATorusAndDoubtsADog)
{
    const auto torus = [](const Vec3& p) { return std::hypot(std::hypot(p.x(), p.y()) - 0.7, p.z()) - 0.2; };
    const auto dog = [](const Vec3& p) {
        double d = segment_distance(p, { 0, 0.1, -0.5 }, { 0, 0.1, 0.4 }) - 0.17;
        d = std::min(d, segment_distance(p, { 0, 0.1, 0.4 }, { 0, 0.5, 0.8 }) - 0.1);
        for (const double x : { -0.14, 0.14 })
            for (const double z : { -0.5, 0.4 })
                d = std::min(d, segment_distance(p, { x, 0, z }, { x, -0.6, z }) - 0.08);
        return d;
    };
    EXPECT_THROW(rig_body(body_of(shape(torus))), InvalidInput);
    EXPECT_THROW(rig_body(body_of(shape(dog)), { .humanlike = Humanlike::strict }), InvalidInput);
    EXPECT_LT(rig_body(body_of(shape(dog))).human_probability, 0.1);
}

TEST(RigBody, RefusesClosedClothes)
{
    const fixtures::Person person = capsule_person({ .spacing = 0.03 });
    const auto worn = [&](const Vec3& p) {  // no head, hands or feet
        for (const int limb : { lradius, rradius, ltibia, rtibia, thorax })
            if ((p - person.skeleton.tail(limb)).dot(limb == thorax ? Vec3::UnitY() : person.skeleton.direction(limb))
                    > -0.02
                && (p - person.skeleton.tail(limb)).norm() < 0.4)
                return false;
        return true;
    };
    const TriangleMesh suit = cut(person.mesh, worn);
    expect_invalid([&] { rig_body(body_of(suit)); }, "widen to a hand or foot");
}

}  // namespace
