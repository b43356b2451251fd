// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a glTF file says of the shape or the pose that its meshes had, and that is wrong once their vertices have moved.

#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

namespace garmentfit {

/// A node whose mesh has moved, and where the mesh stands without its skin.
struct MovedNode {
    int node = 0;
    Eigen::Affine3d world_from_mesh;
};

/// "a skin", "morph targets", "tangents", "animations": those that meshes of these nodes have.
std::vector<std::string> list_stale(const nlohmann::ordered_json& json, const std::vector<int>& nodes);

/// Removes these from meshes of the nodes, and all animations. A mesh with a skin hangs on a node of its own then.
/// @throws nlohmann::json::exception: a member of an unexpected type
void remove_stale(nlohmann::ordered_json& json, const std::vector<MovedNode>& moved);

}  // namespace garmentfit
