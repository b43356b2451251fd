// SPDX-License-Identifier: GPL-3.0-or-later
#include "bind_spaces.h"

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "scene_nodes.h"
#include "tuning.h"

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

/// The scene's space from that of each node, by name.
using NodePlaces = std::map<std::string, aiMatrix4x4>;

struct SkinnedMesh {
    aiMesh* mesh;
    aiMatrix4x4 scene_from_node;
};

void list_nodes(const aiScene& scene, const aiNode& node, const aiMatrix4x4& scene_from_parent, NodePlaces& places,
                std::vector<SkinnedMesh>& meshes)
{
    const aiMatrix4x4 scene_from_node = scene_from_parent * node.mTransformation;
    places.emplace(node.mName.C_Str(), scene_from_node);
    for (unsigned i = 0; i < node.mNumMeshes; ++i)
        if (aiMesh* const mesh = scene.mMeshes[node.mMeshes[i]]; mesh->mNumBones > 0)
            meshes.push_back({ mesh, scene_from_node });
    for (unsigned i = 0; i < node.mNumChildren; ++i)
        list_nodes(scene, *node.mChildren[i], scene_from_node, places, meshes);
}

/// A joint, and the middle of the skin that hangs on it where its mesh's node and where the bind matrix shows it.
struct HeldSkin {
    aiVector3D joint, by_node, by_bind;
    float weight = 0;
};

void list_held_skin(const SkinnedMesh& skinned, const NodePlaces& places, std::vector<HeldSkin>& held)
{
    const aiMesh& mesh = *skinned.mesh;
    for (const aiBone* bone : bones_of(mesh)) {
        aiVector3D middle;
        HeldSkin skin;
        for (unsigned i = 0; i < bone->mNumWeights; ++i)
            if (const aiVertexWeight& of = bone->mWeights[i]; of.mVertexId < mesh.mNumVertices) {
                middle += mesh.mVertices[of.mVertexId] * of.mWeight;
                skin.weight += of.mWeight;
            }
        const auto place = places.find(bone->mName.C_Str());
        if (place == places.end() || !(skin.weight > 0))
            continue;
        middle /= skin.weight;
        skin.joint = aiVector3D(place->second.a4, place->second.b4, place->second.c4);
        skin.by_node = skinned.scene_from_node * middle;
        skin.by_bind = place->second * bone->mOffsetMatrix * middle;
        held.push_back(skin);
    }
}

/// Sum over the skin.
float distance_from_joints(const std::vector<HeldSkin>& held, aiVector3D HeldSkin::*shown)
{
    float sum = 0;
    for (const HeldSkin& skin : held)
        sum += skin.weight * (skin.*shown - skin.joint).Length();
    return sum;
}

}  // namespace

void rename_meshes_called_as_joints(aiScene& scene)
{
    std::set<std::string> others, joints;
    visit_nodes(*scene.mRootNode, [&](const aiNode& node) {
        if (node.mNumMeshes == 0)
            others.insert(node.mName.C_Str());
    });
    for (unsigned m = 0; m < scene.mNumMeshes; ++m)
        for (const aiBone* bone : bones_of(*scene.mMeshes[m]))
            if (others.contains(bone->mName.C_Str()))
                joints.insert(bone->mName.C_Str());
    visit_nodes(*scene.mRootNode, [&](aiNode& node) {
        if (node.mNumMeshes > 0 && joints.contains(node.mName.C_Str()))
            node.mName = std::string(node.mName.C_Str()) + "_mesh";
    });
}

void restore_bind_shapes(aiScene& scene)
{
    NodePlaces places;
    std::vector<SkinnedMesh> meshes;
    if (scene.mRootNode)
        list_nodes(scene, *scene.mRootNode, {}, places, meshes);
    std::vector<HeldSkin> held;
    for (const SkinnedMesh& skinned : meshes)
        list_held_skin(skinned, places, held);
    if (!(distance_from_joints(held, &HeldSkin::by_node)
          < k_much_nearer_joints * distance_from_joints(held, &HeldSkin::by_bind)))
        return;
    for (const SkinnedMesh& skinned : meshes)
        for (aiBone* const bone : bones_of(*skinned.mesh))
            if (const auto place = places.find(bone->mName.C_Str()); place != places.end())
                bone->mOffsetMatrix = aiMatrix4x4(place->second).Inverse() * skinned.scene_from_node;
}

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
