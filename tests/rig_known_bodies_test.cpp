// SPDX-License-Identifier: GPL-3.0-or-later

// Rigs of bodies whose joints are known: tests/bodies.

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <numeric>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "fit/io.h"
#include "fit/rig_body.h"

namespace {

using namespace fit;

struct KnownBody {
    const char* name;
    double mean, worst;  ///< of stature, over the twelve joints; measured, and a quarter more
};

constexpr KnownBody k_bodies[] = {
    { "child_a_pose", 0.015, 0.03 },          { "heavy_man_arms_down", 0.018, 0.04 },
    { "man_a_pose", 0.015, 0.03 },            { "muscular_man_hands_on_hips", 0.015, 0.035 },
    { "old_woman_sitting", 0.018, 0.04 },     { "tall_man_fighting", 0.017, 0.04 },
    { "woman_squatting", 0.016, 0.035 },      { "woman_t_pose", 0.015, 0.03 },
};

constexpr std::array k_forearms { lradius, rradius };

struct JointPlace {
    const char* name;
    int bone;  ///< at whose tail it is
};

constexpr JointPlace k_joints[] = { { "lhip", lhipjoint },  { "lknee", lfemur },     { "lankle", ltibia },
                                    { "rhip", rhipjoint },  { "rknee", rfemur },     { "rankle", rtibia },
                                    { "lshoulder", lclavicle }, { "lelbow", lhumerus }, { "lwrist", lradius },
                                    { "rshoulder", rclavicle }, { "relbow", rhumerus }, { "rwrist", rradius } };

BodyMesh body_of(const std::string& name)
{
    const MeshFile file = MeshFile::read(FIT_BODIES "/" + name + ".ply");
    return make_body(file.positions(), file.triangles());
}

/// Distance of each joint from the true one, as a share of stature.
std::vector<double> errors(const std::string& name, const Skeleton& skeleton)
{
    std::ifstream file(FIT_BODIES "/" + name + ".json");
    const nlohmann::json truth = nlohmann::json::parse(file);
    std::vector<double> result;
    for (const JointPlace& joint : k_joints) {
        const nlohmann::json& p = truth["joints"][joint.name];
        const Vec3 place(p[0].get<double>(), p[1].get<double>(), p[2].get<double>());
        result.push_back((skeleton.tail(joint.bone) - place).norm() / truth["stature"].get<double>());
    }
    return result;
}

double mean(const std::vector<double>& values)
{
    return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

double volume(const Positions& positions, const Triangles& triangles, const std::vector<bool>& counts)
{
    double sum = 0;
    const Vec3 origin = positions.colwise().mean();
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        const Vec3 a = positions.row(triangles(f, 0)).transpose() - origin, b = positions.row(triangles(f, 1)).transpose() - origin,
                   c = positions.row(triangles(f, 2)).transpose() - origin;
        if (counts[std::size_t(triangles(f, 0))])
            sum += a.cross(b).dot(c) / 6;
    }
    return sum;
}

struct Bend {
    int bone;
    double most;  ///< degrees, of a healthy joint
    bool back;  ///< flexes backwards
};

/// The axis about which a limb's lower bone flexes forwards, square to both bones; across the body where it is straight.
Eigen::Quaterniond flexed(const Rig& rig, const Bend& bend, double share)
{
    const Vec3 across = rig.up.cross(rig.front);  // towards the body's left
    const Vec3 bone = rig.skeleton.direction(bend.bone);
    const Vec3 axis = (across - across.dot(bone) * bone).normalized();
    const double angle = share * bend.most * std::acos(-1) / 180;
    return Eigen::Quaterniond(Eigen::AngleAxisd(bend.back ? angle : -angle, axis));
}

TEST(Slow, JointsOfKnownBodiesAreWhereTheyAre)
{
    std::vector<double> means;
    for (const KnownBody& body : k_bodies) {
        SCOPED_TRACE(body.name);
        const std::vector<double> off = errors(body.name, rig_body(body_of(body.name)).skeleton);
        EXPECT_LT(mean(off), body.mean);
        EXPECT_LT(*std::max_element(off.begin(), off.end()), body.worst);
        means.push_back(mean(off));
    }
    EXPECT_LT(mean(means), 0.013);
}

TEST(Slow, JointsStayWhereHandsAreCutOff)
{
    BodyMesh body = body_of("man_a_pose");
    const Skeleton whole = rig_body(body).skeleton;
    std::vector<int> kept;
    for (int f = 0; f < int(body.surface.triangles.rows()); ++f) {
        const Vec3 p = body.surface.positions(body.surface.triangles.row(f), Eigen::all).colwise().mean().transpose();
        if (std::none_of(k_forearms.begin(), k_forearms.end(), [&](int b) {
                return (p - whole.tail(b)).dot(whole.direction(b)) > 0 && (p - whole.tail(b)).norm() < 0.3;
            }))
            kept.push_back(f);
    }
    const Triangles without_hands = body.surface.triangles(kept, Eigen::all);
    const Skeleton cut = rig_body(make_body(body.surface.positions, without_hands)).skeleton;
    EXPECT_LT(mean(errors("man_a_pose", cut)), 0.02);
}

// Shares of stature [drillis_1966_segments]: thigh 0.245, shin 0.246, upper arm 0.186 (0.17 between joint centres), forearm 0.146,
// hips to the base of the neck 0.34. People differ by a tenth, children by more.
TEST(Slow, SegmentsHaveTheProportionsOfPeople)
{
    for (const char* name : { "man_a_pose", "woman_t_pose", "heavy_man_arms_down", "tall_man_fighting" }) {
        SCOPED_TRACE(name);
        const Skeleton s = rig_body(body_of(name)).skeleton;
        const double leg = s.length(lfemur) + s.length(ltibia);  // 0.491 of stature
        EXPECT_NEAR(s.length(lfemur) / leg, 0.245 / 0.491, 0.05);
        EXPECT_NEAR((s.length(lhumerus) + s.length(lradius)) / leg, 0.32 / 0.491, 0.12);
        EXPECT_NEAR(s.length(lradius) / (s.length(lhumerus) + s.length(lradius)), 0.146 / 0.316, 0.06);
        EXPECT_NEAR((s.tail(thorax) - s.root).norm() / leg, 0.34 / 0.491, 0.12);
        EXPECT_NEAR((s.tail(upperneck) - s.tail(thorax)).norm() / leg, 0.06 / 0.491, 0.06);
        EXPECT_NEAR((s.tail(lclavicle) - s.tail(rclavicle)).norm() / leg, 0.2 / 0.491, 0.12);
        for (const int side : { lowerback, upperback, thorax })  // bones of the spine follow each other upwards
            EXPECT_GT((s.tail(side) - s.head(side)).dot(s.tail(thorax) - s.root), 0);
    }
}

TEST(Slow, LimbsKeepTheirVolumeWhenJointsBend)
{
    constexpr Bend bends[] = { { lradius, 140, false }, { rradius, 140, false }, { ltibia, 130, true },
                               { rtibia, 130, true },   { lfemur, 90, false },   { rfemur, 90, false } };
    for (const char* name : { "man_a_pose", "woman_t_pose" }) {
        const BodyMesh body = body_of(name);
        const Rig rig = rig_body(body);
        const Triangles& triangles = body.surface.triangles;
        const std::vector<bool> all(std::size_t(body.surface.positions.rows()), true);
        const double before = volume(body.surface.positions, triangles, all);
        for (const Bend& bend : bends) {
            double limb = 0;  // m^3, of the bone that moves and the one before
            std::vector<bool> on_limb;
            for (Eigen::Index v = 0; v < rig.weights.bones.rows(); ++v)
                on_limb.push_back(rig.weights.bones(v, 0) == bend.bone || rig.weights.bones(v, 0) == parent_of(bend.bone));
            limb = std::abs(volume(body.surface.positions, triangles, on_limb));
            for (const double share : { 0.25, 0.5, 0.75, 1.0 }) {
                Pose pose;
                pose.rotations[std::size_t(bend.bone)] = flexed(rig, bend, share);
                const Positions posed = skin(body.surface.positions, rig.weights, bone_transforms(rig.skeleton, pose));
                EXPECT_LT(std::abs(before - volume(posed, triangles, all)), 0.1 * limb)
                    << name << ": " << bone_name(bend.bone) << " bent by " << share * bend.most << " degrees";
            }
        }
    }
}

}  // namespace
