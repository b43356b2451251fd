// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometric_transforms.h"

#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "scene_nodes.h"

namespace garmentfit {
namespace {

/// In the names of the nodes that Assimp makes of one FBX node.
constexpr std::string_view k_pivot = "_$AssimpFbx$_";
constexpr std::string_view k_geometric = "_$AssimpFbx$_Geometric";

bool is(const aiNode& node, std::string_view kind)
{
    return std::string_view(node.mName.C_Str()).find(kind) != std::string_view::npos;
}

/// It belongs to the node above the child that it places.
bool is_inverse(const aiNode& node)
{
    return is(node, k_geometric) && std::string_view(node.mName.C_Str()).ends_with("Inverse");
}

struct Placement {
    aiMatrix4x4 parent_from_node, node_from_mesh;
};

/// Of nodes with a geometric transform, by name.
using Placements = std::map<std::string, Placement>;

void add_placement(const aiNode& node, Placements& placements)
{
    Placement placement;
    const aiNode* pivot = node.mParent;
    for (; pivot && is(*pivot, k_geometric) && !is_inverse(*pivot); pivot = pivot->mParent)
        placement.node_from_mesh = pivot->mTransformation * placement.node_from_mesh;
    const bool is_geometric = pivot != node.mParent;
    for (; pivot && is(*pivot, k_pivot) && !is_inverse(*pivot); pivot = pivot->mParent)
        placement.parent_from_node = pivot->mTransformation * placement.parent_from_node;
    if (is_geometric && !is(node, k_pivot))
        placements.emplace(node.mName.C_Str(), placement);
}

/// Its meshes move to a child of their own.
void place(const Placement& placement, const aiScene& scene, aiNode& node)
{
    node.mTransformation = placement.parent_from_node;
    aiNode* geometry = new aiNode(std::string(node.mName.C_Str()) + "_geometry");
    geometry->mTransformation = placement.node_from_mesh;
    geometry->mNumMeshes = std::exchange(node.mNumMeshes, 0);
    geometry->mMeshes = std::exchange(node.mMeshes, nullptr);
    node.addChildren(1, &geometry);
    for (unsigned m = 0; m < geometry->mNumMeshes; ++m) {
        const aiMesh& mesh = *scene.mMeshes[geometry->mMeshes[m]];
        for (unsigned b = 0; b < mesh.mNumBones; ++b)  // as ViewScene of Autodesk's SDK does
            mesh.mBones[b]->mOffsetMatrix = mesh.mBones[b]->mOffsetMatrix * placement.node_from_mesh;
    }
}

}  // namespace

void apply_geometric_transforms(const aiScene& exact, aiScene& scene)
{
    Placements placements;
    visit_nodes(*exact.mRootNode, [&](const aiNode& node) { add_placement(node, placements); });
    for (const auto& [name, placement] : placements)
        if (aiNode* const node = scene.mRootNode->FindNode(name.c_str()))
            place(placement, scene, *node);
}

}  // namespace garmentfit
