// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene_file.h"

#include <chrono>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>
#include <assimp/scene.h>
#include <gtest/gtest.h>

#include "fixtures.h"
#include "garmentfit/io.h"
#include "garmentfit/skinned_gltf.h"
#include "mesh_file_samples.h"
#include "run_apart.h"
#include "temporary_folder.h"

namespace {

using namespace garmentfit;
using namespace std::chrono_literals;
using fixtures::expect_invalid;
using SceneFile = fixtures::TemporaryFolder;

/// The same scene in another format.
void convert(const std::filesystem::path& from, const std::filesystem::path& to, const char* format)
{
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile(from.string(), 0);
    ASSERT_TRUE(scene) << importer.GetErrorString();
    Assimp::Exporter exporter;
    ASSERT_EQ(exporter.Export(scene, format, to.string()), aiReturn_SUCCESS) << exporter.GetErrorString();
}

/// The same scene with a mesh in a space of its own, as modelling programs write it whose objects have other units and
/// axes: what it shows stays.
void move_bind_space(aiMesh& mesh, const aiMatrix4x4& own_from_common)
{
    for (unsigned v = 0; v < mesh.mNumVertices; ++v)
        mesh.mVertices[v] *= own_from_common;
    for (unsigned b = 0; b < mesh.mNumBones; ++b)
        mesh.mBones[b]->mOffsetMatrix = mesh.mBones[b]->mOffsetMatrix * aiMatrix4x4(own_from_common).Inverse();
}

/// A square and a triangle of one mesh.
const std::string k_collada = R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
 <asset><unit name="metre" meter="1"/><up_axis>Y_UP</up_axis></asset>
 <library_geometries><geometry id="g"><mesh>
  <source id="p"><float_array id="pa" count="15">0 0 0 1 0 0 1 1 0 0 1 0 0 2 0.5</float_array>
   <technique_common><accessor source="#pa" count="5" stride="3">
    <param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
   </accessor></technique_common></source>
  <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
  <polylist count="2"><input semantic="VERTEX" source="#v" offset="0"/>
   <vcount>4 3</vcount><p>0 1 2 3 3 2 4</p></polylist>
 </mesh></geometry></library_geometries>
 <library_visual_scenes><visual_scene id="s"><node id="n">
  <translate>0 10 0</translate><instance_geometry url="#g"/>
 </node></visual_scene></library_visual_scenes>
 <scene><instance_visual_scene url="#s"/></scene>
</COLLADA>)";

/// A triangle whose node is turned, and which lies beside the origin of that node.
std::string fbx(const std::string& objects, const std::string& connections)
{
    return R"(; FBX 7.4.0 project file
FBXHeaderExtension:  {
 FBXHeaderVersion: 1003
 FBXVersion: 7400
}
Objects:  {
 Geometry: 1000, "Geometry::triangle", "Mesh" {
  Vertices: *9 {
   a: 0,0,0,1,0,0,0,0,1
  }
  PolygonVertexIndex: *3 {
   a: 0,1,-3
  }
 }
 Model: 2000, "Model::beside", "Mesh" {
  Version: 232
  Properties70:  {
   P: "GeometricTranslation", "Vector3D", "Vector", "",10,0,0
   P: "Lcl Rotation", "Lcl Rotation", "", "A",-90,0,0
  }
 }
)" + objects
        + R"(}
Connections:  {
 C: "OO",2000,0
 C: "OO",1000,2000
)" + connections
        + "}\n";
}

TEST_F(SceneFile, TheGeometricTransformOfFbxMovesTheMeshAndNoChild)
{
    const std::string child = R"( Model: 3000, "Model::child", "Mesh" {
  Version: 232
  Properties70:  {
   P: "Lcl Translation", "Lcl Translation", "", "A",0,0,5
  }
 }
)";
    const std::string connections = " C: \"OO\",3000,2000\n C: \"OO\",1000,3000\n";
    const Positions shown = MeshFile::read(save("child.fbx", fbx(child, connections))).positions();
    Positions expected(6, 3);
    expected << 0, 5, 0, 1, 5, 0, 0, 6, 0, 10, 0, 0, 11, 0, 0, 10, 1, 0;
    ASSERT_EQ(shown.rows(), expected.rows());
    EXPECT_LT((shown - expected).cwiseAbs().maxCoeff(), 1e-5);
}

TEST_F(SceneFile, OfLevelsOfDetailTheFinestIsRead)
{
    // the triangle of `fbx`, four times more: a shirt of three levels, and trousers of which only the second is there
    std::string objects, connections;
    const std::vector<std::string> names { "shirt_LOD0", "shirt_LOD1", "shirt_lod2", "trousers_LOD1" };
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::string node = std::to_string(3000 + i), mesh = std::to_string(4000 + i);
        objects += " Geometry: " + mesh + ", \"Geometry::" + names[i] + R"(", "Mesh" {
  Vertices: *9 {
   a: 0,0,)" + std::to_string(i)
            + R"(,1,0,0,0,0,1
  }
  PolygonVertexIndex: *3 {
   a: 0,1,-3
  }
 }
 Model: )" + node
            + ", \"Model::" + names[i] + "\", \"Mesh\" {\n  Version: 232\n }\n";
        connections += " C: \"OO\"," + node + ",0\n C: \"OO\"," + mesh + "," + node + "\n";
    }
    const MeshFile file = MeshFile::read(save("levels.fbx", fbx(objects, connections)));
    std::vector<std::string> shown;
    for (const MeshPart& part : file.parts())
        shown.push_back(part.node);
    EXPECT_EQ(file.triangles().rows(), 3);
    EXPECT_EQ(shown, (std::vector<std::string> { "beside_geometry", "shirt_LOD0", "trousers_LOD1" }));
}

/// For fbx(): a joint at the origin that holds the triangle.
std::string joint_called(const std::string& name)
{
    return " Model: 3000, \"Model::" + name + R"(", "LimbNode" {
  Version: 232
 }
 Deformer: 4000, "Deformer::", "Skin" {
  Version: 101
 }
 Deformer: 5000, "SubDeformer::", "Cluster" {
  Version: 100
  Indexes: *3 {
   a: 0,1,2
  }
  Weights: *3 {
   a: 1,1,1
  }
  Transform: *16 {
   a: 1,0,0,0,0,0,-1,0,0,1,0,0,0,0,0,1
  }
  TransformLink: *16 {
   a: 1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1
  }
 }
)";
}

const std::string k_joint_connections = " C: \"OO\",3000,0\n C: \"OO\",4000,1000\n C: \"OO\",5000,4000\n"
                                        " C: \"OO\",3000,5000\n";

TEST_F(SceneFile, TheGeometricTransformOfFbxMovesASkinnedMesh)
{
    const std::filesystem::path file = save("skin.fbx", fbx(joint_called("joint"), k_joint_connections));
    ASSERT_TRUE(has_skin(file));
    Positions expected(3, 3);
    expected << 10, 0, 0, 11, 0, 0, 10, 1, 0;
    const Positions shown = MeshFile::read(file).positions();
    ASSERT_EQ(shown.rows(), expected.rows());
    EXPECT_LT((shown - expected).cwiseAbs().maxCoeff(), 1e-5) << shown;
}

TEST_F(SceneFile, AMeshIsNotTakenForTheJointOfItsName)
{
    const auto shown_by = [&](const std::string& joint) {
        std::string file = fbx(joint_called(joint), k_joint_connections);
        const std::string_view geometric = "GeometricTranslation";
        file.replace(file.find(geometric), geometric.size(), "Lcl Translation");
        return MeshFile::read(save("named.fbx", file)).positions();
    };
    EXPECT_EQ(shown_by("beside"), shown_by("joint"));  // "beside" is what the mesh is called
}

TEST_F(SceneFile, ColladaIsReadWithItsNodesAndWrittenAsGlb)
{
    const MeshFile mesh = MeshFile::read(save("square.dae", k_collada));
    EXPECT_EQ(mesh.positions().rows(), 5);
    EXPECT_EQ(mesh.triangles().rows(), 3);
    EXPECT_EQ(mesh.positions().col(1).minCoeff(), 10);
    EXPECT_EQ(mesh.positions().col(1).maxCoeff(), 12);
    EXPECT_EQ(mesh.written_name(), "square.glb");
    const Positions moved = mesh.positions().array() + 1;
    expect_invalid([&] { mesh.write(folder / "moved.dae", moved); }, "ends in .glb");
    mesh.write(folder / mesh.written_name(), moved);
    EXPECT_LT((MeshFile::read(folder / "square.glb").positions() - moved).cwiseAbs().maxCoeff(), 1e-6);
}

TEST_F(SceneFile, ASkinnedBodyKeepsItsSkeleton)
{
    const fixtures::Person person = fixtures::capsule_person({ .arm_angle = 60, .elbow_angle = 30 });
    const Rig rig = fixtures::simple_rig(person);
    write_outfit_glb(folder / "body.glb", rig, { { "body", person.mesh, rig.weights } },
                     { .names = BoneNames::smpl });  // hands and feet move skin, and so come along
    convert(folder / "body.glb", folder / "body.dae", "collada");
    ASSERT_TRUE(has_skin(folder / "body.dae"));
    const ForeignRig read = read_skinned_gltf(folder / "body.dae");
    for (const int bone : { lfemur, ltibia, rfemur, lhumerus, rradius })
        EXPECT_LT((read.skeleton.head(bone) - person.skeleton.head(bone)).norm(), 1e-4) << bone_name(bone);
    EXPECT_EQ(read.weights.weights.rows(), MeshFile::read(folder / "body.dae").positions().rows());
}

TEST_F(SceneFile, MeshesWithBindMatricesOfTheirOwnLieWhereTheyBelong)
{
    const fixtures::Person person = fixtures::capsule_person();
    const Rig rig = fixtures::simple_rig(person);
    write_outfit_glb(folder / "dressed.glb", rig,
                     { { "body", person.mesh, rig.weights }, { "suit", person.mesh, rig.weights } },
                     { .names = BoneNames::smpl });
    Assimp::Importer importer;
    importer.ReadFile((folder / "dressed.glb").string(), 0);
    const std::unique_ptr<aiScene> scene(importer.GetOrphanedScene());
    ASSERT_TRUE(scene && scene->mNumMeshes == 2) << importer.GetErrorString();
    move_bind_space(*scene->mMeshes[1], { 0, 0, 100, 3, 0, 100, 0, -20, -100, 0, 0, 7, 0, 0, 0, 1 });
    Assimp::Exporter exporter;
    ASSERT_EQ(exporter.Export(scene.get(), "collada", (folder / "dressed.dae").string()), aiReturn_SUCCESS);

    const Positions shown = MeshFile::read(folder / "dressed.dae").positions();
    const Eigen::Index half = shown.rows() / 2;
    EXPECT_LT((shown.topRows(half) - shown.bottomRows(half)).cwiseAbs().maxCoeff(), 1e-4);
    EXPECT_NEAR(shown.col(1).maxCoeff(), person.mesh.positions.col(1).maxCoeff(), 1e-4);
    EXPECT_NEAR(shown.col(1).minCoeff(), person.mesh.positions.col(1).minCoeff(), 1e-4);
}

TEST_F(SceneFile, ABodyWhoseBindMatricesLackTheTurnOfItsArmatureStands)
{
    const fixtures::Person person = fixtures::capsule_person();
    const Rig rig = fixtures::simple_rig(person);
    write_outfit_glb(folder / "body.glb", rig, { { "body", person.mesh, rig.weights } }, { .names = BoneNames::smpl });
    Assimp::Importer importer;
    importer.ReadFile((folder / "body.glb").string(), 0);
    const std::unique_ptr<aiScene> scene(importer.GetOrphanedScene());
    ASSERT_TRUE(scene && scene->mNumMeshes == 1) << importer.GetErrorString();
    const aiMatrix4x4 scene_from_armature { 0, 0, .01f, 0, 0, .01f, 0, 0, -.01f, 0, 0, 0, 0, 0, 0, 1 };
    move_bind_space(*scene->mMeshes[0], aiMatrix4x4(scene_from_armature).Inverse());
    for (unsigned b = 0; b < scene->mMeshes[0]->mNumBones; ++b) {  // as though the mesh lay in the scene's space
        aiMatrix4x4& joint_from_mesh = scene->mMeshes[0]->mBones[b]->mOffsetMatrix;
        joint_from_mesh = joint_from_mesh * aiMatrix4x4(scene_from_armature).Inverse();
    }
    aiNode* const shown = scene->mRootNode->FindNode("body");
    ASSERT_TRUE(shown && shown->mNumMeshes == 1);
    shown->mTransformation = scene_from_armature * shown->mTransformation;
    Assimp::Exporter exporter;
    ASSERT_EQ(exporter.Export(scene.get(), "collada", (folder / "body.dae").string()), aiReturn_SUCCESS);

    const ForeignRig read = read_skinned_gltf(folder / "body.dae");
    const Positions positions = MeshFile::read(folder / "body.dae").positions();
    EXPECT_NEAR(positions.col(1).maxCoeff(), person.mesh.positions.col(1).maxCoeff(), 1e-4);
    for (const int bone : { lfemur, ltibia, rfemur, lhumerus, rradius })
        EXPECT_LT((read.skeleton.head(bone) - person.skeleton.head(bone)).norm(), 1e-4) << bone_name(bone);
}

TEST_F(SceneFile, FilesThatOnlyNameTheseFormatsAreReadAsWhatTheyAre)
{
    std::string json = samples::gltf_json("");
    json.replace(json.find("by hand"), 7, "<COLLADA> to glTF, FBXHeaderExtension");
    EXPECT_EQ(MeshFile::read(save("square.glb", samples::glb(json))).positions().rows(), 4);
    EXPECT_EQ(MeshFile::read(save("roof.obj", "# from <COLLADA\n" + samples::obj())).format(), "obj");
    EXPECT_EQ(MeshFile::read(save("square.dae", "\xef\xbb\xbf\n" + k_collada)).positions().rows(), 5);
}

TEST_F(SceneFile, WhatIsMangledIsRefused)
{
    const std::vector<std::pair<std::string, std::string>> files {
        { "cut.dae", k_collada.substr(0, 700) },
        { "empty.dae", "<?xml version=\"1.0\"?><COLLADA></COLLADA>" },
        { "text.fbx", "; FBX 7.4.0 project file\nFBXHeaderExtension:  {\n" },
        { "binary.fbx", std::string("Kaydara FBX Binary  \0\x1a\0\0\0", 26) },
    };
    for (const auto& file : files)
        expect_invalid([&] { MeshFile::read(save(file.first, file.second)); }, file.first + ": cannot be read as");
}

TEST(RunApart, ReturnsWhatTheWorkReturnsHoweverLong)
{
    const std::string bytes(3'000'000, 'x');
    const ApartResult result = run_apart([&] { return bytes; }, 20s);
    EXPECT_TRUE(result.is_done);
    EXPECT_EQ(result.bytes, bytes);
}

TEST(RunApart, SurvivesFailuresCrashesAndHangs)
{
    const ApartResult failed = run_apart([]() -> std::string { throw std::runtime_error("no such thing"); }, 20s);
    EXPECT_FALSE(failed.is_done);
    EXPECT_EQ(failed.bytes, "no such thing");
    const ApartResult crashed = run_apart([]() -> std::string { std::abort(); }, 20s);
    EXPECT_FALSE(crashed.is_done);
    EXPECT_FALSE(crashed.out_of_time);
    const ApartResult hangs = run_apart(
        []() -> std::string {
            std::this_thread::sleep_for(60s);
            return "";
        },
        1s);
    EXPECT_FALSE(hangs.is_done);
    EXPECT_TRUE(hangs.out_of_time);
}

}  // namespace
