// SPDX-License-Identifier: GPL-3.0-or-later

// What write_skinned_glb and write_animated_glb write, opened by another library. An executable of its own: assimp
// brings a tinygltf of another version along, which would be called in place of ours.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <assimp/Importer.hpp>
#include <assimp/scene.h>
#include <gtest/gtest.h>

#include "fixtures.h"
#include "garmentfit/animated_gltf.h"
#include "garmentfit/error.h"
#include "garmentfit/skinned_gltf.h"
#include "temporary_folder.h"

namespace {

using namespace garmentfit;

using SkinnedGlb = fixtures::TemporaryFolder;

TEST_F(SkinnedGlb, IsReadByAnotherLibraryWithAllBonesAndWeights)
{
    const fixtures::Person person = fixtures::capsule_person();
    const Rig rig = fixtures::simple_rig(person);
    write_skinned_glb(folder / "rigged.glb", person.mesh, rig);
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile((folder / "rigged.glb").string(), 0);
    ASSERT_NE(scene, nullptr) << importer.GetErrorString();
    ASSERT_EQ(scene->mNumMeshes, 1u);
    const aiMesh& mesh = *scene->mMeshes[0];
    EXPECT_EQ(mesh.mNumVertices, unsigned(person.mesh.positions.rows()));
    EXPECT_EQ(mesh.mNumFaces, unsigned(person.mesh.triangles.rows()));
    std::map<std::string, const aiBone*> bones;
    for (unsigned b = 0; b < mesh.mNumBones; ++b)
        bones[mesh.mBones[b]->mName.C_Str()] = mesh.mBones[b];
    std::vector<double> sums(mesh.mNumVertices, 0);
    for (int b = 0; b < bone_count; ++b) {
        ASSERT_TRUE(bones.count(std::string(bone_name(b)))) << bone_name(b);
        const aiBone& bone = *bones[std::string(bone_name(b))];
        const aiMatrix4x4& m = bone.mOffsetMatrix;
        EXPECT_LT((Vec3(-m.a4, -m.b4, -m.c4) - rig.skeleton.head(b)).norm(), 1e-6) << bone_name(b);
        for (unsigned k = 0; k < bone.mNumWeights; ++k)
            sums[bone.mWeights[k].mVertexId] += bone.mWeights[k].mWeight;
    }
    for (const double sum : sums)
        EXPECT_NEAR(sum, 1, 1e-6);
}

TEST_F(SkinnedGlb, HoldsBodyAndClothesOnOneSkeleton)
{
    const fixtures::Person person = fixtures::capsule_person();
    const Rig rig = fixtures::simple_rig(person);
    const GarmentMesh sleeve = fixtures::sleeve_round(person.skeleton, lhumerus, 0.08, 0.02, 0.2);
    TriangleMesh cloth { sleeve.positions, sleeve.triangles };
    cloth.positions.conservativeResize(cloth.positions.rows() + 1, 3);  // a vertex without a face
    cloth.positions.bottomRows<1>().setZero();
    SkinWeights weights;
    weights.bones.setConstant(cloth.positions.rows(), 4, lhumerus);
    weights.weights.setZero(cloth.positions.rows(), 4);
    weights.weights.col(0).setOnes();
    write_skinned_glb(folder / "outfit.glb", person.skeleton,
                      { { "body", person.mesh, rig.weights }, { "sleeve", cloth, weights } });
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile((folder / "outfit.glb").string(), 0);
    ASSERT_NE(scene, nullptr) << importer.GetErrorString();
    ASSERT_EQ(scene->mNumMeshes, 2u);
    const aiMesh& read = *scene->mMeshes[1];
    ASSERT_EQ(read.mNumVertices, unsigned(cloth.positions.rows()));
    for (unsigned v = 0; v < read.mNumVertices; ++v) {
        EXPECT_NEAR(read.mNormals[v].Length(), 1, 1e-5) << v;
        EXPECT_NEAR(read.mVertices[v].x, cloth.positions(v, 0), 1e-6) << v;
    }
    double moved = 0;
    for (unsigned b = 0; b < read.mNumBones; ++b)
        if (read.mBones[b]->mName == aiString(std::string(bone_name(lhumerus))))
            for (unsigned k = 0; k < read.mBones[b]->mNumWeights; ++k)
                moved += read.mBones[b]->mWeights[k].mWeight;
    EXPECT_NEAR(moved, double(cloth.positions.rows()), 1e-4);
    weights.weights.conservativeResize(3, 4);
    EXPECT_THROW(write_skinned_glb(folder / "short.glb", person.skeleton, { { "sleeve", cloth, weights } }),
                 InvalidInput);
    EXPECT_FALSE(std::filesystem::exists(folder / "short.glb"));
}

using AnimatedGlb = fixtures::TemporaryFolder;

TEST_F(AnimatedGlb, IsReadByAnotherLibraryWithAllFrames)
{
    const TriangleMesh mesh = fixtures::capsule_person().mesh;
    std::vector<Positions> frames { mesh.positions, mesh.positions, mesh.positions };
    frames[1].col(1).array() += 0.25;
    frames[2].col(0).array() -= 0.5;
    write_animated_glb(folder / "moving.glb",
                       { { "body", mesh.triangles, frames }, { "shirt", mesh.triangles, frames } }, 0.5);
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile((folder / "moving.glb").string(), 0);
    ASSERT_NE(scene, nullptr) << importer.GetErrorString();
    ASSERT_EQ(scene->mNumMeshes, 2u);
    for (unsigned m = 0; m < 2; ++m) {
        ASSERT_EQ(scene->mMeshes[m]->mNumAnimMeshes, 2u);
        for (unsigned k = 0; k < 2; ++k)
            for (unsigned v = 0; v < scene->mMeshes[m]->mNumVertices; ++v) {
                const aiVector3D& there = scene->mMeshes[m]->mAnimMeshes[k]->mVertices[v];
                ASSERT_LT((Vec3(there.x, there.y, there.z) - frames[k + 1].row(v).transpose()).norm(), 1e-6);
            }
    }
    ASSERT_EQ(scene->mNumAnimations, 1u);
    ASSERT_EQ(scene->mAnimations[0]->mNumMorphMeshChannels, 2u);
    const aiMeshMorphAnim& way = *scene->mAnimations[0]->mMorphMeshChannels[0];
    ASSERT_EQ(way.mNumKeys, 3u);
    EXPECT_NEAR(way.mKeys[2].mTime - way.mKeys[0].mTime, 1000, 1);  // ms
    for (unsigned key = 0; key < 3; ++key)
        for (unsigned target = 0; target < 2; ++target)
            EXPECT_EQ(way.mKeys[key].mWeights[target], key == target + 1 ? 1.0 : 0.0) << key << ' ' << target;
}

TEST_F(AnimatedGlb, RefusesMeshesWithDifferentNumbersOfFrames)
{
    const TriangleMesh mesh = fixtures::capsule_person().mesh;
    EXPECT_THROW(write_animated_glb(folder / "moving.glb",
                                    { { "body", mesh.triangles, { mesh.positions, mesh.positions } },
                                      { "shirt", mesh.triangles, { mesh.positions } } },
                                    0.1),
                 InvalidInput);
    EXPECT_FALSE(std::filesystem::exists(folder / "moving.glb"));
}

}  // namespace
