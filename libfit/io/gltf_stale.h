// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a glTF file says of the shape or the pose that its meshes had, and that is wrong once their vertices have moved.

#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

namespace garmentfit {

/// A node that shows a mesh, and where that is written to stand, without its skin.
struct WrittenNode {
    int node = 0;
    Eigen::Affine3d world_from_mesh;
    bool is_placed_anew = false;  ///< elsewhere than the node says
    bool has_moved = false;  ///< any of its vertices
};

/// "a skin", "morph targets", "tangents", "animations": those that meshes of these nodes have.
std::vector<std::string> list_stale(const nlohmann::ordered_json& json, const std::vector<int>& nodes);

/// Removes these from meshes that have moved, and all animations. One with a skin, or that is placed anew, hangs on a node
/// of its own then, and so does all that follows: meshes stay in their order.
/// @param nodes  all that show a mesh, in the order of the scene; one of them has moved
/// @throws nlohmann::json::exception: a member of an unexpected type
void remove_stale(nlohmann::ordered_json& json, const std::vector<WrittenNode>& nodes);

}  // namespace garmentfit
