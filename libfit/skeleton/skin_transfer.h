// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Transfers skin weights from the proxy surface to the vertices of the user's mesh.

#include <vector>

#include "garmentfit/mesh.h"
#include "garmentfit/skeleton.h"

namespace garmentfit {

/// Transfers weights (n x 17) to the body's vertices from the nearest points with a similar normal, and keeps the four
/// largest of each row. Where fingers touch other skin, the nearest point may belong to that skin. Patches whose bone
/// is far along the skeleton from the bones of the surrounding skin are therefore transferred again, from points of the
/// surrounding bones.
SkinWeights transfer_skin_weights(const TriangleMesh& from, const Eigen::MatrixXd& weights, const BodyMesh& to);

/// A patch of skin whose bones are far along the skeleton from the bones of all skin around it.
struct StrayPatch {
    std::vector<int> vertices;
    std::array<bool, bone_count> near_bones {};  ///< bones of the skin around it, and their neighbours
};

/// Finds patches that are separated from the largest part of their surface by edges whose ends belong to bones three or
/// more steps apart. O(n).
std::vector<StrayPatch> stray_patches(const Triangles& triangles, const std::vector<int>& bone_of_vertex);

}  // namespace garmentfit
