// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/skinned_gltf.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "edited_glb.h"
#include "fixtures.h"
#include "garmentfit/error.h"
#include "garmentfit/io.h"
#include "garmentfit/rig_body.h"
#include "temporary_folder.h"

namespace {

using namespace garmentfit;
using fixtures::capsule_person;
using fixtures::TemporaryFolder;

class SkinnedGltf : public TemporaryFolder {
protected:
    const fixtures::Person person = capsule_person();
    const Rig rig = fixtures::simple_rig(person);
    std::filesystem::path glb;

    void SetUp() override
    {
        TemporaryFolder::SetUp();
        glb = folder / "rigged.glb";
        write_skinned_glb(glb, person.mesh, rig);
    }

    /// Renames joints in the file, to names of the same length: the GLB stays valid.
    void call_joints(const std::map<std::string, std::string>& names) const
    {
        std::string bytes = load(glb);
        for (const auto& [from, to] : names) {
            const std::string old = "\"name\":\"" + from + "\"";
            const std::size_t at = bytes.find(old);
            ASSERT_NE(at, std::string::npos) << from;
            ASSERT_EQ(from.size(), to.size());
            bytes.replace(at, old.size(), "\"name\":\"" + to + "\"");
        }
        save("rigged.glb", bytes);
    }
};

using fixtures::edited;
using fixtures::node_called;
using nlohmann::json;

/// Body and shoes in one file.
class SkinnedParts : public SkinnedGltf {
protected:
    TriangleMesh shoes = fixtures::sheet(4, 0.05, [](double, double) { return 0; });

    void SetUp() override
    {
        SkinnedGltf::SetUp();
        SkinWeights weights;
        weights.bones.setConstant(shoes.positions.rows(), 4, lfemur);
        weights.weights.setZero(shoes.positions.rows(), 4);
        weights.weights.col(0).setOnes();
        write_skinned_glb(glb, rig.skeleton, { { "body", person.mesh, rig.weights }, { "shoes", shoes, weights } });
    }

    Eigen::Index body_rows() const { return person.mesh.positions.rows(); }
    void edit(const std::function<void(json&)>& change) const { save("rigged.glb", edited(load(glb), change)); }
};

TEST_F(SkinnedParts, HaveAsManyWeightsAsTheFileHasVertices)
{
    const ForeignRig read = read_skinned_gltf(glb);
    ASSERT_EQ(read.weights.bones.rows(), MeshFile::read(glb).positions().rows());
    ASSERT_EQ(read.weights.bones.rows(), body_rows() + shoes.positions.rows());
    EXPECT_EQ(read.weights.bones.topRows(body_rows()).leftCols<2>(), rig.weights.bones.leftCols<2>());
    EXPECT_TRUE((read.weights.bones.bottomRows(shoes.positions.rows()).col(0).array() == lfemur).all());
}

TEST_F(SkinnedParts, HangOnTheJointAboveWithoutASkin)
{
    edit([](json& document) {
        json& nodes = document["nodes"];
        const int shoe = node_called(document, "shoes"), shin = node_called(document, "ltibia");
        nodes[std::size_t(shoe)].erase("skin");
        for (json* list : { &document["scenes"][0]["nodes"] })
            list->erase(std::find(list->begin(), list->end(), json(shoe)));
        nodes[std::size_t(shin)]["children"].push_back(shoe);
    });
    const ForeignRig read = read_skinned_gltf(glb);
    ASSERT_EQ(read.weights.bones.rows(), MeshFile::read(glb).positions().rows());
    const auto last = read.weights.bones.bottomRows(shoes.positions.rows());
    EXPECT_TRUE((last.col(0).array() == ltibia).all()) << last.col(0).transpose();
}

TEST_F(SkinnedParts, OfARigidFigureHangOnTheirBones)
{
    edit([](json& document) {
        json& nodes = document["nodes"];
        const std::map<std::string, std::string> bones { { "body", "lowerback" }, { "shoes", "ltibia" } };
        for (const auto& [part, bone] : bones) {
            const int mesh = node_called(document, part);
            nodes[std::size_t(mesh)].erase("skin");
            json& roots = document["scenes"][0]["nodes"];
            roots.erase(std::find(roots.begin(), roots.end(), json(mesh)));
            nodes[std::size_t(node_called(document, bone))]["children"].push_back(mesh);
        }
    });
    EXPECT_FALSE(has_skin(glb));
    ASSERT_TRUE(has_skeleton(glb));
    const ForeignRig read = read_skinned_gltf(glb);
    EXPECT_EQ(read.loose_vertices, 0);
    EXPECT_EQ((read.weights.bones.col(0).array() == lowerback).count(), body_rows());
    EXPECT_EQ((read.weights.bones.col(0).array() == ltibia).count(), shoes.positions.rows());
    for (const int b : { lfemur, rtibia, lhumerus, rradius })
        EXPECT_LT((read.skeleton.tail(b) - rig.skeleton.tail(b)).norm(), 1e-5) << bone_name(b);
}

TEST_F(SkinnedParts, BesideASkeletonAreNoFigureOnIt)
{
    edit([](json& document) {
        for (const char* part : { "body", "shoes" })
            document["nodes"][std::size_t(node_called(document, part))].erase("skin");
    });
    EXPECT_FALSE(has_skeleton(glb));
    fixtures::expect_invalid([&] { read_skinned_gltf(glb); }, "weight");
}

TEST_F(SkinnedParts, WithoutASkinAndAJointFollowWhatTheyLieAt)
{
    edit([](json& document) { document["nodes"][std::size_t(node_called(document, "shoes"))].erase("skin"); });
    const ForeignRig read = read_skinned_gltf(glb);
    EXPECT_EQ(read.loose_vertices, int(shoes.positions.rows()));
    const Eigen::RowVector3d first = shoes.positions.row(0);
    Eigen::Index nearest;
    (person.mesh.positions.rowwise() - first).rowwise().norm().minCoeff(&nearest);
    EXPECT_EQ(read.weights.bones.row(body_rows()), read.weights.bones.row(nearest));
    EXPECT_EQ(read.weights.weights.row(body_rows()), read.weights.weights.row(nearest));
}

TEST_F(SkinnedParts, WithoutWeightsFollowWhatTheyLieAt)
{
    edit([](json& document) {
        json& mesh
            = document["meshes"][std::size_t(document["nodes"][std::size_t(node_called(document, "shoes"))]["mesh"])];
        for (const char* attribute : { "JOINTS_0", "WEIGHTS_0" })
            mesh["primitives"][0]["attributes"].erase(attribute);
    });
    EXPECT_EQ(read_skinned_gltf(glb).loose_vertices, int(shoes.positions.rows()));
    edit([](json& document) {
        for (json& mesh : document["meshes"])
            for (json& primitive : mesh["primitives"])
                primitive["attributes"].erase("WEIGHTS_0");
    });
    fixtures::expect_invalid([&] { read_skinned_gltf(glb); }, "no vertex with a positive weight");
}

TEST_F(SkinnedParts, LieWhereTheirJointsAre)
{
    edit([](json& document) {
        const json roots = document["scenes"][0]["nodes"];
        document["scenes"][0]["nodes"] = { document["nodes"].size() };
        document["nodes"].push_back(
            { { "scale", { 2, 2, 2 } }, { "translation", { 0, 0, 3 } }, { "children", roots } });
    });
    const ForeignRig read = read_skinned_gltf(glb);
    const auto moved = [](const Vec3& p) { return Vec3(2 * p + 3 * Vec3::UnitZ()); };
    for (int b = 0; b < bone_count; ++b)
        EXPECT_LT((read.skeleton.tail(b) - moved(rig.skeleton.tail(b))).norm(), 1e-5) << bone_name(b);
    const Positions positions = MeshFile::read(glb).positions();
    EXPECT_LT((Vec3(positions.row(0)) - moved(person.mesh.positions.row(0))).norm(), 1e-5);
    EXPECT_LT((Vec3(positions.row(body_rows())) - moved(shoes.positions.row(0))).norm(), 1e-5);
}

TEST_F(SkinnedParts, AreReadInTheirBindPose)
{
    const ForeignRig before = read_skinned_gltf(glb);
    edit([](json& document) {
        document["nodes"][std::size_t(node_called(document, "lhumerus"))]["rotation"] = { 0, 0, 0.6, 0.8 };
    });
    const ForeignRig posed = read_skinned_gltf(glb);
    for (int b = 0; b < bone_count; ++b)
        EXPECT_LT((posed.skeleton.tail(b) - before.skeleton.tail(b)).norm(), 1e-6) << bone_name(b);
    EXPECT_LT((Vec3(MeshFile::read(glb).positions().row(0)) - Vec3(person.mesh.positions.row(0))).norm(), 1e-6);
}

TEST_F(SkinnedParts, OfAPosedFileLieTogetherThoughTheirSkinsBeginWithOtherJoints)
{
    edit([](json& document) {
        json skin = document["skins"][0];
        const json joints = skin["joints"];
        const int arm = node_called(document, "lhumerus");
        const auto first = std::find(joints.begin(), joints.end(), json(arm));
        const std::size_t left_out = std::size_t(first - joints.begin());
        json matrices = document["accessors"][skin["inverseBindMatrices"].get<std::size_t>()];
        matrices["byteOffset"] = matrices.value("byteOffset", std::size_t(0)) + 16 * sizeof(float) * left_out;
        matrices["count"] = joints.size() - left_out;
        skin["joints"] = json::array_t(first, joints.end());
        skin["inverseBindMatrices"] = document["accessors"].size();
        document["accessors"].push_back(matrices);
        document["nodes"][std::size_t(node_called(document, "shoes"))]["skin"] = document["skins"].size();
        document["skins"].push_back(skin);
        document["nodes"][std::size_t(arm)]["rotation"] = { 0, 0, 0.6, 0.8 };
    });
    const Positions positions = MeshFile::read(glb).positions();
    EXPECT_LT((Vec3(positions.row(0)) - Vec3(person.mesh.positions.row(0))).norm(), 1e-5);
    EXPECT_LT((Vec3(positions.row(body_rows())) - Vec3(shoes.positions.row(0))).norm(), 1e-5);
}

TEST_F(SkinnedParts, MayHaveASkinWithoutInverseBindMatrices)
{
    edit([](json& document) { document["skins"].push_back({ { "joints", document["skins"][0]["joints"] } }); });
    EXPECT_LT((Vec3(MeshFile::read(glb).positions().row(0)) - Vec3(person.mesh.positions.row(0))).norm(), 1e-6);
    edit([](json& document) { document["skins"][0].erase("inverseBindMatrices"); });  // so all are identities
    const Vec3 moved = Vec3(MeshFile::read(glb).positions().row(0)) - Vec3(person.mesh.positions.row(0));
    EXPECT_LT((moved - rig.skeleton.root).norm(), 1e-5) << moved.transpose();
}

/// The skin lists an arm and then the root, which is above it. The root gets the matrix that follows the arm's.
void list_arm_before_root(json& document)
{
    json& skin = document["skins"][0];
    const json joints = skin["joints"];
    const int arm = node_called(document, "lhumerus");
    const auto left_out = std::size_t(std::find(joints.begin(), joints.end(), json(arm)) - joints.begin());
    json& matrices = document["accessors"][skin["inverseBindMatrices"].get<std::size_t>()];
    matrices["byteOffset"] = matrices.value("byteOffset", std::size_t(0)) + 16 * sizeof(float) * left_out;
    matrices["count"] = 2;
    skin["joints"] = { arm, joints[0] };
}

TEST_F(SkinnedParts, OfAPosedFileLieByTheFirstJointInTheTreeNotInTheList)
{
    edit(list_arm_before_root);
    const Positions before = MeshFile::read(glb).positions();
    edit([](json& document) {
        document["nodes"][std::size_t(node_called(document, "lhumerus"))]["rotation"] = { 0, 0, 0.6, 0.8 };
    });
    EXPECT_EQ(MeshFile::read(glb).positions(), before);
}

/// A GLB in which a joint of the first skin has its bind pose at the origin.
std::string with_joint_at_origin(std::string bytes, const std::string& joint)
{
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, 4);
    const json document = json::parse(bytes.substr(20, length));
    const json& skin = document["skins"][0];
    const auto& joints = skin["joints"];
    const auto row
        = std::size_t(std::find(joints.begin(), joints.end(), json(node_called(document, joint))) - joints.begin());
    const json& accessor = document["accessors"][skin["inverseBindMatrices"].get<std::size_t>()];
    const json& view = document["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    const std::size_t first = 28 + length + view.value("byteOffset", 0u) + accessor.value("byteOffset", 0u);
    const float zeros[3] {};
    std::memcpy(bytes.data() + first + 64 * row + 48, zeros, sizeof zeros);  // the last column
    return bytes;
}

TEST_F(SkinnedGltf, EndsWithoutABindPoseLieWhereTheSceneHasThem)
{
    const ForeignRig before = read_skinned_gltf(glb);
    save("rigged.glb", with_joint_at_origin(load(glb), "head_top"));
    EXPECT_LT((read_skinned_gltf(glb).skeleton.tips[head_top] - before.skeleton.tips[head_top]).norm(), 1e-5);
}

// Bytes of something else stand where the inverse bind matrices should be.
TEST_F(SkinnedParts, LieAtTheirNodesWhereTheSkinHasNoBindPose)
{
    edit([](json& document) {
        const auto accessor
            = [&](const json& index) -> json& { return document["accessors"][index.get<std::size_t>()]; };
        const json& attributes = document["meshes"][0]["primitives"][0]["attributes"];
        for (const json& skin : document["skins"])
            accessor(skin["inverseBindMatrices"])["bufferView"] = accessor(attributes["POSITION"])["bufferView"];
    });
    EXPECT_LT((MeshFile::read(glb).positions().topRows(body_rows()) - person.mesh.positions).cwiseAbs().maxCoeff(),
              1e-6);
    fixtures::expect_invalid([&] { read_skinned_gltf(glb); }, "inverse bind matrices are no transforms");
}

TEST_F(SkinnedParts, MayHaveMoreThanFourJointsAVertex)
{
    // what stood in the first set comes second; the first set hangs on the first joint, with no weight
    edit([](json& document) {
        json& attributes = document["meshes"][0]["primitives"][0]["attributes"];
        const json none = { { "componentType", 5126 },
                            { "type", "VEC4" },
                            { "count", document["accessors"][attributes["WEIGHTS_0"].get<std::size_t>()]["count"] },
                            { "bufferView", document["bufferViews"].size() } };
        document["bufferViews"].push_back(
            { { "buffer", document["buffers"].size() }, { "byteLength", 16 * none["count"].get<std::size_t>() } });
        const std::size_t bytes = 16 * none["count"].get<std::size_t>();
        std::string zeros((bytes + 2) / 3 * 4, 'A');
        for (std::size_t k = 0; k < (3 - bytes % 3) % 3; ++k)
            zeros[zeros.size() - 1 - k] = '=';
        document["buffers"].push_back(
            { { "byteLength", bytes }, { "uri", "data:application/octet-stream;base64," + zeros } });
        attributes["WEIGHTS_1"] = attributes["WEIGHTS_0"];
        attributes["JOINTS_1"] = attributes["JOINTS_0"];
        attributes["WEIGHTS_0"] = document["accessors"].size();
        document["accessors"].push_back(none);
    });
    const ForeignRig read = read_skinned_gltf(glb);
    EXPECT_LT((read.weights.weights.topRows(body_rows()) - rig.weights.weights).cwiseAbs().maxCoeff(), 1e-6);
}

TEST_F(SkinnedParts, OfATypeThatGltfDoesNotAllowAreRefused)
{
    for (const auto& [attribute, type] : { std::pair("JOINTS_0", 5125), std::pair("JOINTS_0", 5120),
                                           std::pair("WEIGHTS_0", 5122), std::pair("WEIGHTS_0", 5125) }) {
        const std::string whole = load(glb);
        edit([&](json& document) {
            const std::size_t accessor = document["meshes"][0]["primitives"][0]["attributes"][attribute];
            document["accessors"][accessor]["componentType"] = type;
        });
        const std::string mangled = load(glb);
        save("mangled.glb", mangled);
        EXPECT_THROW(read_skinned_gltf(folder / "mangled.glb"), InvalidInput) << attribute << " " << type;
        save("rigged.glb", whole);
    }
}

TEST_F(SkinnedGltf, ComesBackAsItWasWritten)
{
    const ForeignRig read = read_skinned_gltf(glb);
    for (int b = 0; b < bone_count; ++b)
        EXPECT_LT((read.skeleton.tail(b) - rig.skeleton.tail(b)).norm(), 1e-6) << bone_name(b);
    for (int e = 0; e < extremity_count; ++e)
        EXPECT_LT((read.skeleton.tips[e] - rig.skeleton.tips[e]).norm(), 1e-6) << e;
    EXPECT_EQ(read.weights.bones.leftCols<2>(), rig.weights.bones.leftCols<2>());
    EXPECT_LT((read.weights.weights - rig.weights.weights).cwiseAbs().maxCoeff(), 1e-6);
}

/// Body and rig with joints whose names say nothing.
class UnnamedSkeleton : public SkinnedGltf {
protected:
    void write(BoneNames names, const std::function<std::string(int, const std::string&)>& name) const
    {
        const Rig near = fixtures::nearest_rig(person);
        write_outfit_glb(glb, near, { { "body", person.mesh, near.weights } }, { names });
        save("rigged.glb", edited(load(glb), [&](json& document) {
                 for (json& skin : document["skins"])
                     for (const json& joint : skin["joints"]) {
                         json& node = document["nodes"][joint.get<std::size_t>()];
                         node["name"] = name(joint.get<int>(), node["name"]);
                     }
             }));
    }

    void expect_own_skeleton(const ForeignRig& read, const std::string& what) const
    {
        for (const int b : { lfemur, ltibia, rfemur, rtibia, lclavicle, lhumerus, lradius, rclavicle, rhumerus, rradius,
                             lhipjoint, rhipjoint })
            EXPECT_LT((read.skeleton.tail(b) - rig.skeleton.tail(b)).norm(), 1e-5) << what << ", " << bone_name(b);
        EXPECT_LT((read.skeleton.root - rig.skeleton.root).norm(), 1e-5) << what;
    }
};

TEST_F(UnnamedSkeleton, IsFoundByItsTreeAndPlaces)
{
    for (const BoneNames names : { BoneNames::garmentfit, BoneNames::mixamo, BoneNames::unreal, BoneNames::smpl })
        for (const auto& [what, name] :
             { std::pair<std::string, std::function<std::string(int, const std::string&)>>(
                   "numbers", [](int joint, const std::string&) { return "joint" + std::to_string(joint); }),
               { "Blender", [](int joint, const std::string&) { return "Bone.0" + std::to_string(17 * joint % 50); } },
               { "nothing", [](int, const std::string&) { return ""; } } }) {
            write(names, name);
            const ForeignRig read = read_skinned_gltf(glb);
            EXPECT_TRUE(read.by_tree);
            expect_own_skeleton(read, what + " " + std::to_string(int(names)));
            EXPECT_NO_THROW(check_skeleton(make_body(person.mesh.positions, person.mesh.triangles), read.skeleton));
        }
}

/// Takes a joint out of the skin, as exporters do where it has no weight; its node stays.
void take_out(json& document, const std::string& name)
{
    for (json& skin : document["skins"])
        for (json& joint : skin["joints"])
            if (joint == node_called(document, name))
                joint = skin["joints"][0];
}

TEST_F(SkinnedGltf, TakesJointsWithoutSkinFromTheNodesBetweenOthers)
{
    const Rig near = fixtures::nearest_rig(person);
    write_outfit_glb(glb, near, { { "body", person.mesh, near.weights } }, { BoneNames::mixamo });
    save("rigged.glb", edited(load(glb), [](json& document) {
             take_out(document, "mixamorig:Neck");
             document["nodes"][std::size_t(node_called(document, "mixamorig:Spine"))]["rotation"]
                 = { 0.6, 0, 0, 0.8 };  // posed
         }));
    const ForeignRig read = read_skinned_gltf(glb);
    EXPECT_LT((read.skeleton.tail(thorax) - rig.skeleton.tail(thorax)).norm(), 1e-5);
}

TEST_F(SkinnedGltf, APelvisBelowTheHipsIsRaisedToThem)
{
    Rig low = fixtures::nearest_rig(person);
    const auto between_hips = [](const Skeleton& s) { return Vec3(0.5 * (s.tail(lhipjoint) + s.tail(rhipjoint))); };
    low.skeleton.root = between_hips(low.skeleton) - Vec3(0.1, 0.12, 0);
    write_outfit_glb(glb, low, { { "body", person.mesh, low.weights } }, { BoneNames::mixamo });
    const Skeleton raised = read_skinned_gltf(glb).skeleton;
    EXPECT_NEAR(raised.root.y(), between_hips(raised).y(), 0.005);
    EXPECT_NEAR(raised.root.x(), between_hips(raised).x(), 0.005);

    Rig high = low;
    high.skeleton.root = between_hips(low.skeleton) + Vec3(0, 0.06, 0);
    write_outfit_glb(glb, high, { { "body", person.mesh, high.weights } }, { BoneNames::mixamo });
    EXPECT_LT((read_skinned_gltf(glb).skeleton.root - high.skeleton.root).norm(), 1e-5);
}

TEST_F(SkinnedGltf, APelvisThatTheFileLacksLiesBetweenTheHips)
{
    const Rig near = fixtures::nearest_rig(person);
    write_outfit_glb(glb, near, { { "body", person.mesh, near.weights } }, { BoneNames::mixamo });
    save("rigged.glb", edited(load(glb), [](json& document) {
             document["nodes"][std::size_t(node_called(document, "mixamorig:Hips"))]["name"] = "Box";
             for (const char* toes : { "mixamorig:LeftToeBase", "mixamorig:RightToeBase" })  // as for no human's tree
                 document["nodes"][std::size_t(node_called(document, toes))]["name"] = "Box";
             for (const char* hand : { "mixamorig:LeftHand", "mixamorig:RightHand" })
                 take_out(document, hand);
         }));
    const ForeignRig read = read_skinned_gltf(glb);
    const Vec3 between_hips = 0.5 * (rig.skeleton.tail(lhipjoint) + rig.skeleton.tail(rhipjoint));
    EXPECT_LT((read.skeleton.root - between_hips).norm(), 0.05);
    EXPECT_NO_THROW(check_skeleton(make_body(person.mesh.positions, person.mesh.triangles), read.skeleton));
}

constexpr const char* k_ends[]
    = { "head", "head_top", "lhand", "lhand_tip", "rhand", "rhand_tip", "lfoot", "lfoot_tip", "rfoot", "rfoot_tip" };

TEST_F(SkinnedGltf, TakesHandsFeetAndHeadWithoutSkinFromTheNodesBelowJoints)
{
    save("rigged.glb", edited(load(glb), [](json& document) {
             for (const char* end : k_ends)
                 take_out(document, end);
             document["nodes"][std::size_t(node_called(document, "ltibia"))]["rotation"] = { 0.6, 0, 0, 0.8 };  // posed
         }));
    const ForeignRig read = read_skinned_gltf(glb);
    EXPECT_FALSE(read.by_tree);
    for (const int b : { ltibia, rtibia, lradius, rradius, upperneck })
        EXPECT_LT((read.skeleton.tail(b) - rig.skeleton.tail(b)).norm(), 1e-5) << bone_name(b);
    for (int e = 0; e < extremity_count; ++e)
        EXPECT_LT((read.skeleton.tips[e] - rig.skeleton.tips[e]).norm(), 1e-5) << e;
}

/// These joints have neither skin nor names.
template <class Joints>
void forget(json& document, const Joints& joints)
{
    for (const char* joint : joints) {
        take_out(document, joint);
        document["nodes"][std::size_t(node_called(document, joint))]["name"] = "end";
    }
}

/// Hands, feet and the head.
void forget_ends(json& document) { forget(document, k_ends); }

TEST_F(SkinnedGltf, PlacesHandsFeetAndHeadThatTheFileLacksByTheSkin)
{
    const Rig near = fixtures::nearest_rig(person);
    write_outfit_glb(glb, near, { { "body", person.mesh, near.weights } }, { BoneNames::garmentfit });
    save("rigged.glb", edited(load(glb), forget_ends));
    const ForeignRig read = read_skinned_gltf(glb);
    EXPECT_FALSE(read.by_tree);
    for (const int b : { ltibia, rtibia, lradius, rradius, upperneck })
        EXPECT_LT((read.skeleton.tail(b) - rig.skeleton.tail(b)).norm(), 0.06) << bone_name(b);
    EXPECT_NO_THROW(check_skeleton(make_body(person.mesh.positions, person.mesh.triangles), read.skeleton));
}

// A shin and a forearm of blocks have corners at both ends, and nothing between.
TEST_F(SkinnedGltf, PlacesHandsAndFeetThatTheFileLacksOnLimbsOfBlocks)
{
    Rig blocks = fixtures::nearest_rig(person);
    for (Eigen::Index v = 0; v < blocks.weights.bones.rows(); ++v)
        for (const int limb : { ltibia, rtibia, lradius, rradius })
            if (blocks.weights.bones(v, 0) == limb) {
                const Vec3 way = Vec3(person.mesh.positions.row(v)) - rig.skeleton.head(limb);
                const double along = way.dot(rig.skeleton.direction(limb)) / rig.skeleton.length(limb);
                if (along > 0.15 && along < 0.9)
                    blocks.weights.bones(v, 0) = parent_of(limb);
            }
    write_outfit_glb(glb, blocks, { { "body", person.mesh, blocks.weights } }, { BoneNames::garmentfit });
    save("rigged.glb", edited(load(glb), forget_ends));
    const ForeignRig read = read_skinned_gltf(glb);
    for (const int b : { ltibia, rtibia, lradius, rradius })
        EXPECT_LT((read.skeleton.tail(b) - rig.skeleton.tail(b)).norm(), 0.06) << bone_name(b);
}

/// Gives a joint a parent at its place, whose name it doubles, as the volumes of Second Life do.
void double_joint(json& document, const std::string& name, const std::string& double_name)
{
    const int node = node_called(document, name);
    const int parent = int(document["nodes"].size());
    for (json& other : document["nodes"])
        if (other.contains("children"))
            for (json& child : other["children"])
                if (child == node)
                    child = parent;
    json above = document["nodes"][std::size_t(node)];
    above["children"] = { node };
    document["nodes"].push_back(above);
    json& below = document["nodes"][std::size_t(node)];
    for (const char* part : { "translation", "rotation", "scale", "matrix" })
        below.erase(part);
    below["name"] = double_name;
}

TEST_F(SkinnedGltf, PlacesWhatTheFileLacksWhereTheSkinHangsOnVolumes)
{
    const Rig near = fixtures::nearest_rig(person);
    write_outfit_glb(glb, near, { { "body", person.mesh, near.weights } }, { BoneNames::garmentfit });
    save("rigged.glb", edited(load(glb), [](json& document) {
             forget_ends(document);
             double_joint(document, "ltibia", "L_LOWER_LEG");
             double_joint(document, "rtibia", "R_LOWER_LEG");
             double_joint(document, "lradius", "L_LOWER_ARM");
             double_joint(document, "rradius", "R_LOWER_ARM");
         }));
    const ForeignRig read = read_skinned_gltf(glb);
    EXPECT_FALSE(read.by_tree);
    for (const int b : { ltibia, rtibia, lradius, rradius })
        EXPECT_LT((read.skeleton.tail(b) - rig.skeleton.tail(b)).norm(), 0.06) << bone_name(b);
}

constexpr const char* k_limb_ends[]
    = { "lhand", "lhand_tip", "rhand", "rhand_tip", "lfoot", "lfoot_tip", "rfoot", "rfoot_tip" };
constexpr std::pair<int, const char*> k_lower_limbs[]
    = { { lradius, "lradius" }, { rradius, "rradius" }, { ltibia, "ltibia" }, { rtibia, "rtibia" } };

TEST_F(SkinnedGltf, DividesLimbsOfOneBone)
{
    Rig whole = fixtures::nearest_rig(person);
    for (Eigen::Index v = 0; v < whole.weights.bones.rows(); ++v)
        for (const auto& [bone, name] : k_lower_limbs)
            if (whole.weights.bones(v, 0) == bone)
                whole.weights.bones(v, 0) = parent_of(bone);
    write_outfit_glb(glb, whole, { { "body", person.mesh, whole.weights } }, { BoneNames::garmentfit });
    save("rigged.glb", edited(load(glb), [](json& document) {
             const auto take_out_as_helper = [&](const char* name) {
                 take_out(document, name);
                 document["nodes"][std::size_t(node_called(document, name))]["name"] = "end";
             };
             for (const auto& [bone, name] : k_lower_limbs)
                 take_out_as_helper(name);
             for (const char* end : k_limb_ends)
                 take_out_as_helper(end);
         }));
    const ForeignRig read = read_skinned_gltf(glb);
    EXPECT_FALSE(read.by_tree);
    for (const auto& [bone, name] : k_lower_limbs) {
        EXPECT_LT((read.skeleton.head(bone) - rig.skeleton.head(bone)).norm(), 0.08) << name;
        EXPECT_LT((read.skeleton.tail(bone) - rig.skeleton.tail(bone)).norm(), 0.08) << name;
        EXPECT_TRUE((read.weights.bones.col(0).array() == bone).any()) << name << " moves skin";
    }
    EXPECT_NO_THROW(check_skeleton(make_body(person.mesh.positions, person.mesh.triangles), read.skeleton));
}

/// Joints for shoulder and elbow, hip and knee, as in "Arm.L" and "Hand.L" of figures of games.
void call_middles_ends(json& document)
{
    forget(document, k_limb_ends);
    for (const auto& [middle, end] : std::map<std::string, std::string> {
             { "lradius", "lhand" }, { "rradius", "rhand" }, { "ltibia", "lfoot" }, { "rtibia", "rfoot" } })
        document["nodes"][std::size_t(node_called(document, middle))]["name"] = end;
}

TEST_F(SkinnedGltf, TakesWhatIsCalledAHandOrFootInTheMiddleOfALimbForItsElbowOrKnee)
{
    const Rig near = fixtures::nearest_rig(person);
    write_outfit_glb(glb, near, { { "body", person.mesh, near.weights } }, { BoneNames::garmentfit });
    save("rigged.glb", edited(load(glb), call_middles_ends));
    const ForeignRig read = read_skinned_gltf(glb);
    EXPECT_FALSE(read.by_tree);
    for (const auto& [bone, name] : k_lower_limbs) {
        EXPECT_LT((read.skeleton.head(bone) - rig.skeleton.head(bone)).norm(), 1e-5) << name;
        EXPECT_LT((read.skeleton.tail(bone) - rig.skeleton.tail(bone)).norm(), 0.06) << name;
        EXPECT_TRUE((read.weights.bones.col(0).array() == bone).any()) << name << " moves skin";
    }
    EXPECT_NO_THROW(check_skeleton(make_body(person.mesh.positions, person.mesh.triangles), read.skeleton));
}

TEST_F(SkinnedGltf, TakesJointsWithoutAKnownNameForElbowsAndKneesThatAreMissing)
{
    const Rig near = fixtures::nearest_rig(person);
    write_outfit_glb(glb, near, { { "body", person.mesh, near.weights } }, { BoneNames::garmentfit });
    save("rigged.glb", edited(load(glb), [](json& document) {
             for (const auto& [from, to] : std::map<std::string, std::string> { { "lradius", "lhumerus.001" },
                                                                                { "rradius", "rhumerus.001" },
                                                                                { "ltibia", "Canilla izquierda" },
                                                                                { "rtibia", "Canilla derecha" },
                                                                                { "lfoot", "Pie izquierdo" } })
                 document["nodes"][std::size_t(node_called(document, from))]["name"] = to;
             for (const char* tip : { "lfoot_tip", "rfoot_tip" }) {  // without feet, the tree does not tell the sides
                 take_out(document, tip);
                 document["nodes"][std::size_t(node_called(document, tip))]["name"] = "Dedos";
             }
         }));
    const ForeignRig read = read_skinned_gltf(glb);
    EXPECT_FALSE(read.by_tree);
    for (const auto& [bone, name] : k_lower_limbs) {
        EXPECT_LT((read.skeleton.head(bone) - rig.skeleton.head(bone)).norm(), 1e-5) << name;
        EXPECT_LT((read.skeleton.tail(bone) - rig.skeleton.tail(bone)).norm(), 1e-5) << name;
    }
}

TEST_F(SkinnedGltf, TakesNoMeshForAJointBelowOthers)
{
    const Rig near = fixtures::nearest_rig(person);
    write_outfit_glb(glb, near, { { "body", person.mesh, near.weights } }, { BoneNames::garmentfit });
    save("rigged.glb", edited(load(glb), [](json& document) {
             take_out(document, "lfoot");
             take_out(document, "lfoot_tip");
             document["nodes"][std::size_t(node_called(document, "lfoot"))]["mesh"] = 0;
         }));
    const ForeignRig read = read_skinned_gltf(glb);
    EXPECT_GT((read.skeleton.tail(ltibia) - rig.skeleton.tail(ltibia)).norm(), 1e-4) << "by the skin, not by the node";
    EXPECT_LT((read.skeleton.tail(rtibia) - rig.skeleton.tail(rtibia)).norm(), 1e-5);
}

TEST_F(SkinnedGltf, TakesTheLowerOfTwoNecks)
{
    const Rig near = fixtures::nearest_rig(person);
    write_outfit_glb(glb, near, { { "body", person.mesh, near.weights } }, { BoneNames::mixamo });
    save("rigged.glb", edited(load(glb), [](json& document) {
             take_out(document, "mixamorig:Spine2");  // so that it is not the first in the skin
             document["nodes"][std::size_t(node_called(document, "mixamorig:Spine2"))]["name"] = "mixamorig:Neck1";
         }));
    const ForeignRig read = read_skinned_gltf(glb);
    EXPECT_LT((read.skeleton.tail(thorax) - rig.skeleton.tail(upperback)).norm(), 1e-5);
}

TEST_F(UnnamedSkeleton, OfAVrmAvatarIsWhatTheFileSays)
{
    write(BoneNames::vrm, [](int, const std::string& name) { return name; });
    const std::string named = load(glb);
    const auto give_up_names = [](json& document, bool is_new) {
        json bones = is_new ? json::object() : json::array();
        for (const json& joint : document["skins"][0]["joints"]) {
            json& name = document["nodes"][joint.get<std::size_t>()]["name"];
            if (is_new)
                bones[name.get<std::string>()] = { { "node", joint } };
            else
                bones.push_back({ { "bone", name }, { "node", joint } });
            name = "Left Knee";  // of every joint
        }
        document["extensions"] = { { is_new ? "VRMC_vrm" : "VRM", { { "humanoid", { { "humanBones", bones } } } } } };
    };
    for (const bool is_new : { true, false }) {
        save("rigged.glb", edited(named, [&](json& document) { give_up_names(document, is_new); }));
        const ForeignRig read = read_skinned_gltf(glb);
        EXPECT_FALSE(read.by_tree);
        for (const int b : { lfemur, rtibia, lhumerus })
            EXPECT_GT(read.skeleton.length(b), 0.2);
        EXPECT_GT(read.skeleton.tail(lfemur).x(), read.skeleton.tail(rfemur).x());
    }
    save("rigged.glb", edited(named, [&](json& document) {
             document["extensions"]
                 = { { "VRMC_vrm", { { "humanoid", { { "humanBones", { { "hips", 3 }, { "head", { 1 } } } } } } } },
                     { "VRM",
                       { { "humanoid", { { "humanBones", { 1, { { "bone", 2 } }, { { "node", "x" } } } } } } } } };
         }));
    EXPECT_NO_THROW(read_skinned_gltf(glb));
}

TEST_F(SkinnedGltf, NamesTheJointThatItCannotFind)
{
    call_joints({ { "lfemur", "thing1" } });  // and skin hangs on bones anywhere, so places say nothing
    fixtures::expect_invalid([&] { read_skinned_gltf(glb); }, "left hip");
}

TEST_F(SkinnedGltf, UnderstandsOtherNamesForJoints)
{
    call_joints(
        { { "lfemur", "LUpLeg" }, { "rtibia", "shin_r" }, { "lhumerus", "arm-left" }, { "lradius", "elbow_l" } });
    const ForeignRig read = read_skinned_gltf(glb);
    for (const int b : { lfemur, rtibia, lhumerus, lradius })
        EXPECT_LT((read.skeleton.head(b) - rig.skeleton.head(b)).norm(), 1e-6) << bone_name(b);
}

TEST_F(SkinnedGltf, RefusesAMeshWithoutASkin)
{
    const auto no = save("no.gltf", R"({"asset":{"version":"2.0"},"nodes":[{"name":"a"}],"scenes":[{"nodes":[0]}]})");
    fixtures::expect_invalid([&] { read_skinned_gltf(no); }, "skin");
}

}  // namespace
