// SPDX-License-Identifier: GPL-3.0-or-later
#include "bind_spaces.h"

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <assimp/scene.h>

namespace garmentfit {
namespace {

constexpr float k_same = 1e-4f;  // unit: rounding of products of matrices in single precision, translations in cm

/// Joint from common space.
using BindMatrices = std::map<std::string, aiMatrix4x4>;

std::vector<aiBone*> bones_of(const aiMesh& mesh) { return { mesh.mBones, mesh.mBones + mesh.mNumBones }; }

/// By the joint with most vertices among those that have a matrix already; none where there is none.
std::optional<aiMatrix4x4> common_from_mesh(const aiMesh& mesh, const BindMatrices& binds)
{
    const aiBone* best = nullptr;
    for (const aiBone* bone : bones_of(mesh))
        if (const auto bind = binds.find(bone->mName.C_Str());
            bind != binds.end() && bind->second.Determinant() != 0 && (!best || bone->mNumWeights > best->mNumWeights))
            best = bone;
    if (!best)
        return {};
    return aiMatrix4x4(binds.at(best->mName.C_Str())).Inverse() * best->mOffsetMatrix;
}

void transform(const aiMatrix4x4& matrix, unsigned count, aiVector3D* points)
{
    for (unsigned i = 0; points && i < count; ++i)
        points[i] *= matrix;
}

/// Directions, by a matrix that keeps their plane.
void turn(const aiMatrix3x3& matrix, unsigned count, aiVector3D* directions)
{
    for (unsigned i = 0; directions && i < count; ++i)
        directions[i] = (matrix * directions[i]).NormalizeSafe();
}

template <class Mesh>
void move_points(const aiMatrix4x4& common, Mesh& mesh)
{
    const aiMatrix3x3 along(common);
    const aiMatrix3x3 across = aiMatrix3x3(along).Inverse().Transpose();
    transform(common, mesh.mNumVertices, mesh.mVertices);
    turn(across, mesh.mNumVertices, mesh.mNormals);
    turn(along, mesh.mNumVertices, mesh.mTangents);
    turn(along, mesh.mNumVertices, mesh.mBitangents);
}

/// Towards a mirrored space faces turn round, too.
void move(const aiMatrix4x4& common, aiMesh& mesh)
{
    move_points(common, mesh);
    for (unsigned i = 0; i < mesh.mNumAnimMeshes; ++i)
        move_points(common, *mesh.mAnimMeshes[i]);
    const bool is_mirrored = common.Determinant() < 0;
    for (unsigned f = 0; is_mirrored && f < mesh.mNumFaces; ++f)
        std::swap(mesh.mFaces[f].mIndices[0], mesh.mFaces[f].mIndices[mesh.mFaces[f].mNumIndices - 1]);
    const aiMatrix4x4 mesh_from_common = aiMatrix4x4(common).Inverse();
    for (aiBone* const bone : bones_of(mesh))
        bone->mOffsetMatrix = bone->mOffsetMatrix * mesh_from_common;
}

/// A mesh that shares a joint with those before, else the first one.
std::vector<aiMesh*>::iterator next_of(std::vector<aiMesh*>& meshes, const BindMatrices& binds)
{
    for (auto mesh = meshes.begin(); mesh != meshes.end(); ++mesh)
        if (common_from_mesh(**mesh, binds))
            return mesh;
    return meshes.begin();
}

}  // namespace

void unify_bind_spaces(aiScene& scene)
{
    std::vector<aiMesh*> meshes;
    for (unsigned m = 0; m < scene.mNumMeshes; ++m)
        if (scene.mMeshes[m]->mNumBones > 0)
            meshes.push_back(scene.mMeshes[m]);
    BindMatrices binds;
    while (!meshes.empty()) {
        const auto next = next_of(meshes, binds);
        aiMesh& mesh = **next;
        meshes.erase(next);
        const std::optional<aiMatrix4x4> common = common_from_mesh(mesh, binds);
        if (common && common->Determinant() != 0 && !common->Equal(aiMatrix4x4(), k_same))
            move(*common, mesh);
        for (const aiBone* bone : bones_of(mesh))
            binds.emplace(bone->mName.C_Str(), bone->mOffsetMatrix);
    }
}

}  // namespace garmentfit
