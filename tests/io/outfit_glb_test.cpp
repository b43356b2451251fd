// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "file_bytes.h"
#include "fixtures.h"
#include "garmentfit/error.h"
#include "garmentfit/io.h"
#include "garmentfit/skinned_gltf.h"
#include "gltf_container.h"
#include "joint_tree.h"
#include "temporary_folder.h"

namespace {

using namespace garmentfit;
using Json = nlohmann::ordered_json;
using OutfitGlb = fixtures::TemporaryFolder;

struct Model {
    fixtures::Person person = fixtures::capsule_person({ .arm_angle = 60, .elbow_angle = 30 });
    Rig rig = fixtures::simple_rig(person);
    std::vector<SkinnedMesh> meshes { { "body", person.mesh, rig.weights } };
};

Json json_of(const std::filesystem::path& glb) { return read_gltf_container(read_file(glb)).json; }

/// Where joints are in the file, by their names.
std::map<std::string, Vec3> places_of(const Json& json)
{
    std::map<std::string, Vec3> places;
    const std::function<void(int, Eigen::Isometry3d)> visit = [&](int index, Eigen::Isometry3d world) {
        const Json& node = json.at("nodes").at(std::size_t(index));
        if (node.contains("translation"))
            world.translate(Vec3(node["translation"][0], node["translation"][1], node["translation"][2]));
        if (node.contains("rotation"))
            world.rotate(Eigen::Quaterniond(node["rotation"][3].get<double>(), node["rotation"][0], node["rotation"][1],
                                            node["rotation"][2]));
        places[node.at("name")] = world.translation();
        for (const Json& child : node.value("children", Json::array()))
            visit(child, world);
    };
    for (const Json& root : json.at("scenes")[0].at("nodes"))
        visit(root, Eigen::Isometry3d::Identity());
    return places;
}

TEST_F(OutfitGlb, HasTheJointsOfEachProgram)
{
    const Model model;
    const std::map<BoneNames, std::vector<std::string>> wanted {
        { BoneNames::garmentfit, { "root", "lhipjoint", "lfemur", "lhand", "rfoot_tip" } },
        { BoneNames::mixamo,
          { "mixamorig:Hips", "mixamorig:Spine2", "mixamorig:LeftForeArm", "mixamorig:RightToeBase" } },
        { BoneNames::unreal, { "root", "pelvis", "spine_03", "lowerarm_l", "hand_r", "ball_l" } },
        { BoneNames::smpl, { "pelvis", "spine3", "left_collar", "right_wrist", "left_hand", "right_foot" } },
    };
    for (const auto& [names, joints] : wanted) {
        write_outfit_glb(folder / "outfit.glb", model.rig, model.meshes, { .names = names });
        const auto places = places_of(json_of(folder / "outfit.glb"));
        for (const std::string& joint : joints)
            EXPECT_TRUE(places.count(joint)) << joint;
        EXPECT_EQ(json_of(folder / "outfit.glb").at("skins")[0].at("joints").size(), places.size() - 1);
        const ForeignRig back = read_skinned_gltf(folder / "outfit.glb");
        for (const int bone : { lfemur, ltibia, rfemur, lhumerus, rradius })
            EXPECT_LT((back.skeleton.head(bone) - model.person.skeleton.head(bone)).norm(), 1e-6)
                << joints[0] << ' ' << bone_name(bone);
    }
    write_outfit_glb(folder / "smpl.glb", model.rig, model.meshes, { .names = BoneNames::smpl });
    EXPECT_EQ(json_of(folder / "smpl.glb").at("skins")[0].at("joints").size(), 24u);
}

TEST_F(OutfitGlb, OfGarmentfitIsTheSameAsTheRig)
{
    const Model model;
    write_outfit_glb(folder / "outfit.glb", model.rig, model.meshes);
    write_skinned_glb(folder / "rigged.glb", model.person.mesh, model.rig);
    EXPECT_EQ(read_file(folder / "outfit.glb").bytes, read_file(folder / "rigged.glb").bytes);
}

TEST_F(OutfitGlb, OfVrmHasTheHumanoidMapAndStandsInTPoseFacingZ)
{
    Model model;
    const Eigen::AngleAxisd turn(1.2, Vec3::UnitY());  // of a body that faces elsewhere
    for (auto row : model.meshes[0].surface.positions.rowwise())
        row = (turn * Vec3(row.transpose())).transpose();
    model.rig.skeleton.root = turn * model.rig.skeleton.root;
    for (Vec3& place : model.rig.skeleton.tails)
        place = turn * place;
    for (Vec3& place : model.rig.skeleton.tips)
        place = turn * place;
    model.rig.front = turn * model.rig.front;
    write_outfit_glb(folder / "avatar.vrm", model.rig, model.meshes, { .names = BoneNames::vrm, .title = "Ada" });

    const Json json = json_of(folder / "avatar.vrm");
    EXPECT_EQ(json.at("extensionsUsed"), Json({ "VRMC_vrm" }));
    const Json& vrm = json.at("extensions").at("VRMC_vrm");
    EXPECT_EQ(vrm.at("specVersion"), "1.0");
    EXPECT_EQ(vrm.at("meta").at("name"), "Ada");
    EXPECT_EQ(vrm.at("meta").at("authors").size(), 1u);
    EXPECT_EQ(vrm.at("meta").at("licenseUrl"), "https://vrm.dev/licenses/1.0/");
    const Json& bones = vrm.at("humanoid").at("humanBones");
    std::set<int> nodes;
    for (const auto& [name, bone] : bones.items()) {
        const int node = bone.at("node");
        EXPECT_EQ(json.at("nodes").at(std::size_t(node)).at("name"), name);
        EXPECT_TRUE(nodes.insert(node).second) << "one node for each bone";
    }
    for (const char* side : { "left", "right" })
        for (const char* part : { "UpperLeg", "LowerLeg", "Foot", "UpperArm", "LowerArm", "Hand" })
            EXPECT_TRUE(bones.contains(std::string(side) + part)) << side << part;
    for (const char* bone : { "hips", "spine", "head" })
        EXPECT_TRUE(bones.contains(bone)) << bone;

    auto places = places_of(json);
    const Vec3 arm = (places["leftHand"] - places["leftUpperArm"]).normalized();
    EXPECT_GT(arm.x(), 0.999) << "left is +x where the body faces +z";
    EXPECT_LT((places["rightHand"] - places["rightUpperArm"]).normalized().x(), -0.999);
    EXPECT_GT((places["leftToes"] - places["leftFoot"]).z(), 0.02);
}

TEST_F(OutfitGlb, HandsAndFeetMoveTheirSkinAndNoVertexHasAJointTwice)
{
    const Model model;
    for (const BoneNames names : { BoneNames::vrm, BoneNames::mixamo, BoneNames::unreal, BoneNames::smpl }) {
        const JointTree tree = joint_tree(model.rig.skeleton, names);
        const FileWeights weights
            = file_weights(tree, model.rig.skeleton, model.person.mesh.positions, joint_weights_of(model.rig.weights));
        double of_hand = 0;
        const int hand = tree.extremities[lhand_tip], forearm = tree.joint_of[lradius];
        ASSERT_GE(hand, 0);
        for (Eigen::Index v = 0; v < weights.weights.rows(); ++v) {
            ASSERT_NEAR(weights.weights.row(v).sum(), 1, 1e-9);
            for (int k = 0; k < 4; ++k)
                for (int other = 0; other < k; ++other)
                    ASSERT_FALSE(weights.weights(v, k) > 0 && weights.joints(v, k) == weights.joints(v, other));
            const Vec3 place = model.person.mesh.positions.row(v);
            const double along = (place - model.rig.skeleton.tail(lradius)).dot(model.rig.skeleton.direction(lradius));
            for (int k = 0; k < 4; ++k)
                if (weights.joints(v, k) == hand && weights.weights(v, k) > 0) {
                    of_hand += weights.weights(v, k);
                    EXPECT_GT(along, -0.2 * model.rig.skeleton.length(lradius));
                } else if (weights.joints(v, k) == forearm && weights.weights(v, k) > 0) {
                    EXPECT_LT(along, 0.2 * model.rig.skeleton.length(lradius));
                }
        }
        EXPECT_GT(of_hand, 1);
    }
}

/// Of six bones each, the later ones with larger weights.
JointWeights of_six_bones(Eigen::Index vertices)
{
    JointWeights weights(vertices, bone_count);
    for (Eigen::Index v = 0; v < vertices; ++v)
        for (int k = 0; k < 6; ++k)
            weights.insert(v, lowerback + k) = (k + 1) / 21.0;
    return weights;
}

TEST_F(OutfitGlb, HasAsManyJointsAVertexAsAMeshBrings)
{
    Model model;
    model.meshes.push_back({ .name = "cloth", .surface = model.person.mesh, .weights = model.rig.weights });
    model.meshes.back().more_weights = of_six_bones(model.person.mesh.positions.rows());
    write_outfit_glb(folder / "outfit.glb", model.rig, model.meshes);
    const Json meshes = json_of(folder / "outfit.glb").at("meshes");
    EXPECT_FALSE(meshes[0].at("primitives")[0].at("attributes").contains("JOINTS_1")) << "four are enough";
    for (const char* name : { "JOINTS_0", "WEIGHTS_0", "JOINTS_1", "WEIGHTS_1" })
        EXPECT_TRUE(meshes[1].at("primitives")[0].at("attributes").contains(name)) << name;

    const Eigen::MatrixXd read = read_joint_weights(folder / "outfit.glb"), given = model.meshes.back().more_weights;
    const Eigen::MatrixXd of_cloth = read.bottomRows(given.rows());
    for (Eigen::Index v = 0; v < given.rows(); ++v) {
        Eigen::VectorXd expected = given.row(v), found = of_cloth.row(v);
        std::sort(expected.begin(), expected.end(), std::greater<>());
        std::sort(found.begin(), found.end(), std::greater<>());
        ASSERT_LT((found.head(bone_count) - expected).cwiseAbs().maxCoeff(), 1e-6) << v;
    }
}

TEST_F(OutfitGlb, PutsTheStrongestJointsFirst)
{
    const Model model;
    const JointTree tree = joint_tree(model.rig.skeleton, BoneNames::mixamo);
    const Positions places = model.person.mesh.positions.topRows(3);
    const FileWeights weights = file_weights(tree, model.rig.skeleton, places, of_six_bones(3));
    ASSERT_EQ(weights.weights.cols(), 8);
    for (Eigen::Index v = 0; v < 3; ++v) {
        EXPECT_NEAR(weights.weights.row(v).sum(), 1, 1e-12);
        for (int k = 1; k < 8; ++k)
            EXPECT_GE(weights.weights(v, k - 1), weights.weights(v, k));
    }
}

TEST_F(OutfitGlb, RefusesWeightsOfAnotherMesh)
{
    Model model;
    model.meshes[0].more_weights = of_six_bones(3);
    EXPECT_THROW(write_outfit_glb(folder / "outfit.glb", model.rig, model.meshes), InvalidInput);
    EXPECT_FALSE(std::filesystem::exists(folder / "outfit.glb"));
}

}  // namespace
