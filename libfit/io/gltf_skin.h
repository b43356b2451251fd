// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The skins of a glTF file as they are: joints by their own names, and the weights of all vertices.

#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "gltf_model.h"

namespace garmentfit {

/// All skins of a file as one: their joints are merged by node. Nodes between joints are joints, too, which hold no
/// skin: exporters leave out what has no weight, such as hips, necks and clavicles. Rows are in the order of the scene,
/// parents first.
struct FileSkin {
    std::vector<int> nodes;  ///< of each joint
    std::vector<std::string> names;
    std::vector<int> parents;  ///< earlier rows of the same; -1 none
    std::vector<Vec3> places;  ///< in the bind pose
    std::vector<Eigen::Affine3d, Eigen::aligned_allocator<Eigen::Affine3d>> joint_from_world;  ///< in the bind pose
    std::vector<std::vector<std::pair<int, double>>> hangs;  ///< of each vertex of MeshFile: joints and weights
    Positions positions;  ///< of all vertices, where the scene shows them
    std::vector<int> loose;  ///< vertices that hung on no joint, ascending
};

/// A weight as it counts: none where it is negative or no number.
double positive(double weight);

/// Vertices of which weights are negative or no numbers, or do not sum to 1. Those without any are `loose`.
int count_unnormalized(const FileSkin& skin);

/// Nodes below the last joints hold no skin, and are a hand, foot or head that an exporter left out of the skin as it has
/// no weight, or the goal, weapon or camera of an animator.
enum class NodesBelow { left_out, taken };

/// Whether the scene shows a mesh with a skin, or one that hangs on a joint of a skin: figures of rigid parts, each on its
/// bone, have no other weights.
bool shows_skeleton(const FileBytes& file, const tinygltf::Model& model);

/// A mesh without a skin hangs on the joint above it; what hangs on none, or has no weight, follows the nearest vertex
/// that has one. @throws InvalidInput: no skinned mesh, mangled
FileSkin read_skin(const FileBytes& file, const tinygltf::Model& model, NodesBelow below = NodesBelow::left_out);

}  // namespace garmentfit
