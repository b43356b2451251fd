// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Materials and UVs on their way into a GLB.

#include <vector>

#include "garmentfit/appearance.h"
#include "glb_model.h"

namespace garmentfit {

/// Adds pictures, textures and materials. @return the row of the first of them in model.materials
int add_materials(const Appearance& look, GlbModel& glb);

/// Vertices as glTF has them: one UV each. Those of the file come first, in their order; where a vertex has several
/// UVs, copies follow.
struct SeamVertices {
    std::vector<int> sources;  ///< of each vertex its row in the file
    Triangles triangles;
    Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> uvs;  ///< without rows: none
};
SeamVertices split_at_seams(Eigen::Index vertices, const Triangles& triangles, const Appearance& look);

}  // namespace garmentfit
