// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// From the vertices that were weighed to the user's own.

#include <vector>

#include "garmentfit/mesh.h"
#include "garmentfit/skeleton.h"

namespace garmentfit {

/// Carries weights (n x 17) to the body's own vertices by the nearest points that face the same way, and keeps the four largest of each row.
/// Where fingers touch other skin the nearest point may belong to that: skin which hangs on a bone far along the skeleton from what its
/// neighbours hang on is carried anew, from points that suit the neighbours.
SkinWeights transfer_skin_weights(const TriangleMesh& from, const Eigen::MatrixXd& weights, const BodyMesh& to);

/// Skin that hangs on other bones than all the skin around it, and no way along the skeleton leads there.
struct StrayPatch {
    std::vector<int> vertices;
    std::array<bool, bone_count> near_bones {};  ///< those of the skin around it, and the bones next to them
};

/// Patches of vertices cut off from the largest part of their surface by edges whose ends hang on bones more than two steps apart. O(n).
std::vector<StrayPatch> stray_patches(const Triangles& triangles, const std::vector<int>& bone_of_vertex);

}  // namespace garmentfit
