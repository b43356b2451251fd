// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The nodes of a glTF file's scene and the surfaces that they show: the same ones, in the same order, for all readers.

#include <Eigen/Geometry>
#include <array>
#include <map>
#include <optional>
#include <vector>

#include "gltf_model.h"

namespace garmentfit {

/// A primitive with triangles and positions. Primitives may share vertices: the first one `adds_vertices`.
struct GltfSurface {
    int node;
    const tinygltf::Primitive* primitive;
    Column positions;
    bool adds_vertices;
};

/// Of strips and fans, too, all wound as the primitive says. @param vertices  that it has
/// @throws InvalidInput: indices out of range, or no unsigned integers
std::vector<std::array<int, 3>> triangles_of(const FileBytes& file, const tinygltf::Model& model,
                                             const tinygltf::Primitive& primitive, std::size_t vertices);

class GltfScene {
public:
    /// Keeps references. @throws InvalidInput: a node with two parents, in a cycle, or with a mangled transform
    GltfScene(const FileBytes& file, const tinygltf::Model& model);

    /// Nodes in the order of the tree, parents first.
    const std::vector<int>& nodes() const { return nodes_; }
    /// -1 for a root, and for what is not in the scene.
    int parent(int node) const { return parents_[std::size_t(node)]; }
    const Eigen::Affine3d& world_from_node(int node) const { return world_from_node_[std::size_t(node)]; }
    /// The place of a skinned mesh is that of its joints, not of its node: here of the first one in the tree in its bind
    /// pose, of all skins that share joints. So a posed file shows its bind pose. Where a skin has none, the mesh lies at
    /// its node.
    Eigen::Affine3d world_from_mesh(int node) const;
    std::vector<GltfSurface> surfaces() const;

    /// Whether the inverse bind matrices of a skin are transforms: some exporters leave bytes there that mean nothing,
    /// and would throw the mesh apart. @throws InvalidInput: not a matrix for each joint
    bool has_bind_pose(const tinygltf::Skin& skin) const;
    /// Of a skin, from the mesh to its joint. The identity where the file has none. @throws InvalidInput.
    Eigen::Affine3d joint_from_mesh(const tinygltf::Skin& skin, std::size_t joint) const;

private:
    std::vector<int> roots() const;
    Eigen::Matrix4d inverse_bind_matrix(const tinygltf::Skin& skin, std::size_t joint) const;

    const FileBytes& file_;
    const tinygltf::Model& model_;
    std::vector<int> nodes_, parents_;
    std::vector<Eigen::Affine3d, Eigen::aligned_allocator<Eigen::Affine3d>> world_from_node_;
    mutable std::optional<std::map<int, Eigen::Affine3d>> world_from_skin_;  // by the first call that needs it
};

}  // namespace garmentfit
