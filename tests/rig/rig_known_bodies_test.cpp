// SPDX-License-Identifier: GPL-3.0-or-later

// Rigs of bodies whose joints are known: tests/bodies.

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "garmentfit/io.h"
#include "garmentfit/rig_body.h"

namespace {

using namespace garmentfit;

struct KnownBody {
    const char* name;
    double mean, worst;  ///< of stature, over the twelve joints; the measured value plus a quarter
};

constexpr KnownBody k_bodies[] = {
    { "child_a_pose", 0.015, 0.03 },      { "heavy_man_arms_down", 0.018, 0.04 },
    { "man_a_pose", 0.015, 0.03 },        { "muscular_man_hands_on_hips", 0.015, 0.035 },
    { "old_woman_sitting", 0.018, 0.04 }, { "tall_man_fighting", 0.017, 0.04 },
    { "woman_squatting", 0.016, 0.035 },  { "woman_t_pose", 0.015, 0.03 },
};

constexpr std::array<int, 2> k_forearms { lradius, rradius }, k_shins { ltibia, rtibia };

struct JointPlace {
    const char* name;
    int bone;  ///< at whose tail it is
};

constexpr JointPlace k_joints[]
    = { { "lhip", lhipjoint }, { "lknee", lfemur },        { "lankle", ltibia },       { "rhip", rhipjoint },
        { "rknee", rfemur },   { "rankle", rtibia },       { "lshoulder", lclavicle }, { "lelbow", lhumerus },
        { "lwrist", lradius }, { "rshoulder", rclavicle }, { "relbow", rhumerus },     { "rwrist", rradius } };

BodyMesh body_of(const std::string& name)
{
    const MeshFile file = MeshFile::read(GARMENTFIT_BODIES "/" + name + ".ply");
    return make_body(file.positions(), file.triangles());
}

/// Distance of each joint from the true one, as a share of stature.
std::vector<double> errors(const std::string& name, const Skeleton& skeleton)
{
    std::ifstream file(GARMENTFIT_BODIES "/" + name + ".json");
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

/// Volume between a point and the triangles whose first corner counts, m^3.
double volume(const TriangleMesh& mesh, const Vec3& origin, const std::function<bool(int)>& counts)
{
    double sum = 0;
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
        const auto corner = [&](int k) { return Vec3(mesh.positions.row(mesh.triangles(f, k)).transpose() - origin); };
        if (counts(mesh.triangles(f, 0)))
            sum += corner(0).cross(corner(1)).dot(corner(2)) / 6;
    }
    return sum;
}

double volume(const TriangleMesh& mesh)
{
    return volume(mesh, mesh.positions.colwise().mean(), [](int) { return true; });
}

enum class About { across, front, itself };  ///< the axis of rotation: of the body, or the bone

struct Bend {
    int bone;
    double most;  ///< degrees, of a healthy joint; positive: forwards, outwards for the left, as a screw
    About about;
};

/// The rotation of a bone by a share of its range, about an axis square to the bone.
Eigen::Quaterniond bend_rotation(const Rig& rig, const Bend& bend, double share)
{
    const Vec3 across = rig.front.cross(rig.up);  // towards the body's right
    const Vec3 bone = rig.skeleton.direction(bend.bone);
    const auto square = [&](const Vec3& v) { return Vec3((v - v.dot(bone) * bone).normalized()); };
    const Vec3 axis = bend.about == About::itself ? bone : square(bend.about == About::across ? across : rig.front);
    return Eigen::Quaterniond(Eigen::AngleAxisd(share * bend.most * std::acos(-1) / 180, axis));
}

/// Volume of an arm from the shoulder, of a leg from the hip, or otherwise of the body without limbs.
double volume_of_limb(const BodyMesh& body, const Rig& rig, int bone)
{
    const auto limb = [&](int upper) {  // its cut runs through the joint, so nothing is missing where it is open
        return volume(body.surface, rig.skeleton.head(upper),
                      [&](int v) { return rig.weights.bones(v, 0) == upper || rig.weights.bones(v, 0) == upper + 1; });
    };
    for (const int upper : { lfemur, rfemur, lhumerus, rhumerus })
        if (bone == upper || bone == upper + 1)
            return limb(upper);
    return volume(body.surface) - limb(lfemur) - limb(rfemur) - limb(lhumerus) - limb(rhumerus);
}

TEST(Slow, JointsOfKnownBodiesAreFound)
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

/// In trousers that fall on shoes: shins are nowhere thinner than the shoe is, and toes do not show.
BodyMesh in_wide_trousers(const BodyMesh& body, const Rig& rig)
{
    constexpr double k_trousers = 0.08, k_shoe = 0.05;  // m, radii
    Positions dressed = body.surface.positions;
    const auto push_out = [&](int v, const Vec3& from, const Vec3& axis, double radius) {
        const Vec3 off_head = dressed.row(v).transpose() - from;
        const Vec3 off = off_head - off_head.dot(axis) * axis;
        dressed.row(v) += (std::max(radius - off.norm(), 0.0) * off.normalized()).transpose();
    };
    for (const auto& [shin, foot] : { std::pair(ltibia, lfoot_tip), std::pair(rtibia, rfoot_tip) }) {
        const Vec3 ankle = rig.skeleton.tail(shin), toes = rig.skeleton.tips[foot], down = rig.skeleton.direction(shin);
        for (int v = 0; v < int(dressed.rows()); ++v) {
            if (rig.weights.bones(v, 0) != shin)
                continue;
            const double along = (dressed.row(v).transpose() - ankle).dot(down);
            if (along < 0.03 && along > -rig.skeleton.length(shin))
                push_out(v, ankle, down, k_trousers);
            else if (along > 0)
                push_out(v, ankle + 0.04 * down, (toes - ankle - 0.04 * down).normalized(), k_shoe);
        }
    }
    return make_body(dressed, body.surface.triangles);
}

TEST(Slow, FeetAreFoundUnderWideTrousers)
{
    for (const char* name : { "man_a_pose", "woman_t_pose" }) {
        SCOPED_TRACE(name);
        const BodyMesh body = body_of(name);
        const Rig dressed = rig_body(in_wide_trousers(body, rig_body(body)));
        const std::vector<double> off = errors(name, dressed.skeleton);
        EXPECT_LT(mean(off), 0.03);
        EXPECT_LT(*std::max_element(off.begin(), off.end()), 0.06);
    }
}

/// The body without the faces beyond the ends of two bones. Their vertices stay.
BodyMesh cut_off(const BodyMesh& body, const Rig& rig, const std::array<int, 2>& bones)
{
    std::vector<int> kept;
    for (int f = 0; f < int(body.surface.triangles.rows()); ++f) {
        const int corner = body.surface.triangles(f, 0), bone = rig.weights.bones(corner, 0);
        const Vec3 beyond = body.surface.positions.row(corner).transpose() - rig.skeleton.tail(bone);
        if (std::find(bones.begin(), bones.end(), bone) == bones.end() || beyond.dot(rig.skeleton.direction(bone)) < 0)
            kept.push_back(f);
    }
    return make_body(body.surface.positions, body.surface.triangles(kept, Eigen::all));
}

TEST(Slow, JointsStayWhereHandsOrFeetAreCutOff)
{
    for (const char* name : { "man_a_pose", "woman_t_pose", "heavy_man_arms_down", "old_woman_sitting" }) {
        const BodyMesh body = body_of(name);
        const Rig rig = rig_body(body);
        for (const std::array<int, 2>& bones : { k_forearms, k_shins }) {
            const Skeleton cut = rig_body(cut_off(body, rig, bones)).skeleton;
            const std::vector<double> off = errors(name, cut);
            EXPECT_LT(mean(off), 0.02) << name << " without what is beyond " << bone_name(bones[0]);
            EXPECT_LT(*std::max_element(off.begin(), off.end()), 0.05) << name << ", " << bone_name(bones[0]);
            if (bones == k_shins) {
                EXPECT_LT((cut.tips[lfoot_tip] - cut.tail(ltibia)).norm(), 0.4 * cut.length(ltibia)) << name;
                EXPECT_LT((cut.tips[rfoot_tip] - cut.tail(rtibia)).norm(), 0.4 * cut.length(rtibia)) << name;
            }
        }
    }
}

TEST(Slow, VerticesOfRemovedHandsBelongToTheArmsThoughThighsAreNearer)
{
    const BodyMesh whole = body_of("heavy_man_arms_down"), cut = cut_off(whole, rig_body(whole), k_forearms);
    const Rig rig = rig_body(cut);
    std::vector<bool> has_faces(cut.surface.positions.rows(), false);
    for (Eigen::Index i = 0; i < cut.surface.triangles.size(); ++i)
        has_faces[std::size_t(cut.surface.triangles.data()[i])] = true;
    for (int v = 0; v < int(has_faces.size()); ++v)
        if (!has_faces[std::size_t(v)]) {
            EXPECT_TRUE(rig.weights.bones(v, 0) == lradius || rig.weights.bones(v, 0) == rradius) << v;
        }
}

// Shares of stature [drillis_1966_segments]: thigh 0.245, shin 0.246, upper arm 0.186 (0.17 between joint centres),
// forearm 0.146, hips to the base of the neck 0.34. People differ by a tenth, children by more.
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

TEST(Slow, LimbsKeepTheirVolumeWhenAnyJointBendsThroughItsRange)
{
    constexpr Bend bends[] = {
        { lradius, 140, About::across },  { lradius, 80, About::itself },   { lhumerus, 80, About::front },
        { lhumerus, -45, About::front },  { lhumerus, 80, About::across },  { lhumerus, 60, About::itself },
        { lfemur, 100, About::across },   { lfemur, -20, About::across },   { lfemur, 40, About::front },
        { lfemur, 40, About::itself },    { ltibia, -130, About::across },  { lclavicle, 20, About::front },
        { lowerback, 30, About::across }, { upperback, 30, About::across }, { thorax, 20, About::itself },
        { lowerback, 25, About::front },  { lowerneck, 30, About::across }, { upperneck, 30, About::across },
        { upperneck, 40, About::itself },
    };
    for (const char* name : { "man_a_pose", "woman_t_pose" }) {
        const BodyMesh body = body_of(name);
        const Rig rig = rig_body(body);
        for (const Bend& bend : bends)
            for (const double share : { 0.5, 1.0 }) {
                Pose pose;
                pose.rotations[std::size_t(bend.bone)] = bend_rotation(rig, bend, share);
                const Positions posed = skin(body.surface.positions, rig.weights, bone_transforms(rig.skeleton, pose));
                const double lost = volume(body.surface) - volume({ posed, body.surface.triangles });
                EXPECT_LT(lost, 0.1 * volume_of_limb(body, rig, bend.bone))
                    << name << ": " << bone_name(bend.bone) << " rotated by " << share * bend.most << " degrees";
            }
    }
}

TEST(Slow, SpineNeckAndClaviclesLieInsideInOrder)
{
    for (const KnownBody& known : k_bodies) {
        SCOPED_TRACE(known.name);
        const Skeleton s = rig_body(body_of(known.name)).skeleton;
        const double leg
            = 0.5 * (s.length(lfemur) + s.length(ltibia) + s.length(rfemur) + s.length(rtibia));  // 0.49 of stature
        EXPECT_NEAR((s.tail(lhipjoint) - s.tail(rhipjoint)).norm() / leg, 0.25, 0.04);
        EXPECT_NEAR((s.tail(lclavicle) - s.tail(rclavicle)).norm() / leg, 0.42,
                    0.1);  // 0.21 of stature between joint centres
        for (const int bone : { lowerback, upperback, thorax })  // thirds of hip to neck
            EXPECT_NEAR(s.length(bone) / (s.tail(thorax) - s.root).norm(), 1.0 / 3, 0.07) << bone_name(bone);
        EXPECT_NEAR(s.length(lclavicle) / s.length(rclavicle), 1, 0.2);
        EXPECT_NEAR((s.tail(upperneck) - s.tail(thorax)).norm() / leg, 0.11, 0.06);  // 0.052 of stature
    }
}

}  // namespace
