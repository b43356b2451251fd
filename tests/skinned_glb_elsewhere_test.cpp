// SPDX-License-Identifier: GPL-3.0-or-later

// What write_skinned_glb writes, opened by another library. On its own: assimp brings a tinygltf of another version along, which
// would be called in place of ours.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <assimp/Importer.hpp>
#include <assimp/scene.h>
#include <gtest/gtest.h>

#include "fit/skinned_gltf.h"
#include "fixtures.h"
#include "temporary_folder.h"

namespace {

using namespace fit;

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

}  // namespace
