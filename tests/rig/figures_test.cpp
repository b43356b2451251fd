// SPDX-License-Identifier: GPL-3.0-or-later

// Bodies that have two arms, two legs and a trunk, but not a human's proportions.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "fixtures.h"
#include "garmentfit/error.h"
#include "garmentfit/io.h"
#include "garmentfit/rig_body.h"

namespace {

using namespace garmentfit;

constexpr double k_clearly_human = 0.6;  // below it, hosts warn

const RigOptions k_strict { .humanlike = Humanlike::strict };

/// How many times as long and thick parts are as in the human.
struct Factors {
    double head = 1, arms = 1, legs = 1;

    double of(int bone) const
    {
        for (const int arm : { lhumerus, lradius, rhumerus, rradius })
            if (bone == arm)
                return arms;
        for (const int leg : { lfemur, ltibia, rfemur, rtibia })
            if (bone == leg)
                return legs;
        return bone == upperneck ? head : 1;
    }
};

/// Scales each part about its joint and moves what hangs on it along.
class Cartoon {
public:
    Cartoon(const TriangleMesh& human, const Rig& rig, const Factors& factors) :
        mesh_(human), skeleton_(rig.skeleton), factors_(factors), from_(rig.skeleton)
    {
        for (int b = 0; b < bone_count; ++b)  // parents come before children
            skeleton_.tails[b] = place(b, from_.tail(b));
        for (Eigen::Index v = 0; v < human.positions.rows(); ++v) {
            Vec3 sum = Vec3::Zero();
            for (int k = 0; k < 4; ++k)
                sum += rig.weights.weights(v, k) * place(rig.weights.bones(v, k), human.positions.row(v));
            mesh_.positions.row(v) = sum;
        }
    }

    const TriangleMesh& mesh() const { return mesh_; }

    /// All joints, as a user would give them.
    GivenJoints joints() const
    {
        GivenJoints joints { skeleton_.root, {}, {} };
        for (int b = 0; b < bone_count; ++b)
            joints.tails[b] = skeleton_.tail(b);
        return joints;
    }

    /// Of the twelve joints of the limbs from where they were moved, a share of the height.
    double mean_error(const Skeleton& found) const
    {
        const double height = mesh_.positions.col(1).maxCoeff() - mesh_.positions.col(1).minCoeff();
        double sum = 0;
        for (const int bone : { lhipjoint, lfemur, ltibia, lclavicle, lhumerus, lradius })
            for (const int side : { bone, mirror_of(bone) })
                sum += (found.tail(side) - skeleton_.tail(side)).norm() / height / 12;
        return sum;
    }

private:
    Vec3 place(int bone, const Vec3& point) const
    {
        return skeleton_.head(bone) + factors_.of(bone) * (point - from_.head(bone));
    }

    TriangleMesh mesh_;
    Skeleton skeleton_;
    Factors factors_;
    Skeleton from_;
};

TriangleMesh human(const std::string& name)
{
    const MeshFile file = MeshFile::read(GARMENTFIT_BODIES "/" + name + ".ply");
    return { file.positions(), file.triangles() };
}

TEST(Slow, CartoonsAreRiggedAndSaidToBeFarFromHuman)
{
    constexpr Factors k_chibi { 2.5, 0.7, 0.45 }, k_ape { 1, 1.5, 0.5 };
    for (const char* name : { "man_a_pose", "woman_t_pose" }) {
        const TriangleMesh mesh = human(name);
        const Rig rig = rig_body(make_body(mesh.positions, mesh.triangles));
        EXPECT_EQ(rig.human_probability, 1);
        EXPECT_TRUE(rig.not_human.empty());
        for (const Factors& factors : { k_chibi, k_ape }) {
            SCOPED_TRACE(std::string(name) + ", head " + std::to_string(factors.head));
            const Cartoon cartoon(mesh, rig, factors);
            const Rig found = rig_body(make_body(cartoon.mesh().positions, cartoon.mesh().triangles));
            EXPECT_LT(cartoon.mean_error(found.skeleton), 0.04);
            EXPECT_LT(found.human_probability, k_clearly_human);
            EXPECT_FALSE(found.not_human.empty());
        }
    }
}

/// With the feet below the hem, or on the floor all round.
TriangleMesh person_in_a_gown(const fixtures::Person& person, double hem)
{
    const auto gown = [&](const Vec3& p) {
        const double cone = std::hypot(p.x(), p.z() / 0.8) - (0.15 + 0.2 * (1.05 - p.y()));
        return std::min(fixtures::person_distance(person.skeleton, p),
                        std::max({ 0.9 * cone, p.y() - 1.05, hem - p.y() }));
    };
    return fixtures::polygonise(gown, Vec3(-1, -0.2, -0.5), Vec3(1, 2, 0.5), 0.025);
}

TEST(Slow, LegsInAGownArePlacedAsAHumans)
{
    const fixtures::Person person = fixtures::capsule_person({ .arm_angle = 45 });
    for (const double hem : { 0.06, -0.01 }) {
        const TriangleMesh mesh = person_in_a_gown(person, hem);
        const bool shows_feet = hem > 0;
        const RigOptions options { .front = shows_feet ? std::optional<Vec3>() : Vec3::UnitZ() };
        const Rig rig = rig_body(make_body(mesh.positions, mesh.triangles), options);
        for (const int bone : { lhipjoint, lfemur, ltibia, lclavicle, lhumerus, lradius })
            for (const int side : { bone, mirror_of(bone) })
                EXPECT_LT((rig.skeleton.tail(side) - person.skeleton.tail(side)).norm(), 0.1)
                    << bone_name(side) << " " << hem;
        EXPECT_LT(rig.human_probability, k_clearly_human);
        EXPECT_NE(rig.not_human.find("legs do not show"), std::string::npos) << rig.not_human;
        for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v)
            if (const Vec3 skin = mesh.positions.row(v);
                skin.y() > 0.1 && skin.y() < 0.3 && std::abs(skin.x()) > 0.15) {
                const int bone = rig.weights.bones(v, 0);
                EXPECT_EQ(bone, skin.x() > 0 ? ltibia : rtibia) << skin.transpose() << " " << bone_name(bone);
            }
        if (shows_feet)
            fixtures::expect_invalid([&] { rig_body(make_body(mesh.positions, mesh.triangles), k_strict); }, "body");
    }
}

TEST(Slow, ToesThatMergeBelowAHemShowTheFrontThoughArmsAreHeldBack)
{
    const fixtures::Person person = fixtures::capsule_person({ .arm_angle = 45, .elbow_angle = -10 });
    const auto gown = [&](const Vec3& p) {
        const double cone = std::hypot(p.x(), p.z() / 0.8) - (0.15 + 0.2 * (1.05 - p.y()));
        const Vec3 beyond = (p - Vec3(0, 0.05, 0.15)).cwiseAbs() - Vec3(0.14, 0.05, 0.3);
        return std::min({ fixtures::person_distance(person.skeleton, p), beyond.maxCoeff(),
                          std::max({ 0.9 * cone, p.y() - 1.05, 0.12 - p.y() }) });
    };
    const TriangleMesh mesh = fixtures::polygonise(gown, Vec3(-1, -0.2, -0.6), Vec3(1, 2, 0.8), 0.025);
    const Rig rig = rig_body(make_body(mesh.positions, mesh.triangles));
    EXPECT_NE(rig.not_human.find("legs do not show"), std::string::npos) << rig.not_human;
    EXPECT_GT(rig.front.z(), 0.9);
    EXPECT_GT(rig.skeleton.tail(lhipjoint).x(), 0);
    EXPECT_NEAR(rig.skeleton.tail(ltibia).x(), -rig.skeleton.tail(rtibia).x(), 0.03);
}

TEST(Figures, JointsOfACartoonAreTakenWhereAllAreGiven)
{
    const TriangleMesh mesh = human("man_a_pose");
    const Cartoon ape(mesh, rig_body(make_body(mesh.positions, mesh.triangles)), { 1, 1.5, 0.5 });
    const BodyMesh body = make_body(ape.mesh().positions, ape.mesh().triangles);
    RigOptions options { .joints = ape.joints() };
    const Rig rig = rig_body(body, options);
    EXPECT_LT(ape.mean_error(rig.skeleton), 1e-6);
    EXPECT_LT(rig.human_probability, k_clearly_human);
    EXPECT_NE(rig.not_human.find("arm to leg"), std::string::npos) << rig.not_human;
    options.humanlike = Humanlike::strict;
    fixtures::expect_invalid([&] { rig_body(body, options); }, "a human has");
}

/// A tube in two parts with open ends.
TriangleMesh open_tubes()
{
    const GarmentMesh tube = fixtures::sleeve_round(fixtures::capsule_person().skeleton, lfemur, 0.08, 0, 0.5);
    const Eigen::Index n = tube.positions.rows(), m = tube.triangles.rows();
    TriangleMesh both { Positions(2 * n, 3), Triangles(2 * m, 3) };
    both.positions << tube.positions, tube.positions.rowwise() + Vec3(0, 0.51, 0).transpose();
    both.triangles << tube.triangles, (tube.triangles.array() + int(n)).matrix();
    return both;
}

TEST(Figures, WhyABodyIsNoHumanIsSaidWhereTheTimeForFiguresEnds)
{
    const TriangleMesh mesh = open_tubes();
    const BodyMesh body = make_body(mesh.positions, mesh.triangles);
    std::string refusal;
    for (double seconds = 2; refusal.empty() && seconds < 100; seconds *= 2)  // until no human was found in time
        try {
            const Deadline deadline = Deadline::in(seconds);
            const auto wait_in_search = [&](double fraction, std::string_view) {
                while (fraction > 0.971 && !deadline.has_passed())  // figures come last
                    std::this_thread::sleep_for(std::chrono::milliseconds(10));
                return true;
            };
            rig_body(body, { .proxy_vertices = 1000 }, Progress(wait_in_search).until(deadline));
            FAIL() << "rigged";
        } catch (const TimeLimitReached&) {
            continue;
        } catch (const InvalidInput& error) {
            refusal = error.what();
        }
    EXPECT_NE(refusal.find("give a human body"), std::string::npos) << refusal;
    EXPECT_NE(refusal.find("within the time limit"), std::string::npos) << refusal;
}

TEST(Slow, StrictRefusesApes)
{
    const TriangleMesh mesh = human("man_a_pose");
    const BodyMesh man = make_body(mesh.positions, mesh.triangles);
    const Cartoon ape(mesh, rig_body(man, k_strict), { 1, 1.5, 0.5 });
    fixtures::expect_invalid([&] { rig_body(make_body(ape.mesh().positions, ape.mesh().triangles), k_strict); },
                             "a human has");
}

TEST(Slow, TailsAreNotLegs)
{
    const fixtures::Person person = fixtures::capsule_person();
    const auto fox = [&](const Vec3& p) {
        const double tail = std::min(fixtures::segment_distance(p, { 0, 0.95, -0.08 }, { 0, 0.75, -0.35 }),
                                     fixtures::segment_distance(p, { 0, 0.75, -0.35 }, { 0, 0.85, -0.75 }));
        return std::min(fixtures::person_distance(person.skeleton, p), tail - 0.05);
    };
    const TriangleMesh mesh = fixtures::polygonise(fox, Vec3(-1, -0.2, -1), Vec3(1, 2, 0.5), 0.025);
    const Rig rig = rig_body(make_body(mesh.positions, mesh.triangles));
    for (const int bone : { lhipjoint, lfemur, ltibia, lclavicle, lhumerus, lradius })
        for (const int side : { bone, mirror_of(bone) })
            EXPECT_LT((rig.skeleton.tail(side) - person.skeleton.tail(side)).norm(), 0.1) << bone_name(side);
}

}  // namespace
