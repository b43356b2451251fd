// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How threads run in the triangles of a garment, by its texture coordinates: those of clothes are laid out like pieces of
// a pattern, upright.

#include <vector>

#include "garmentfit/mesh.h"

namespace garmentfit {

/// Along v, in each triangle that has texture coordinates. No rows where there are none, or where u and v meet so
/// askew on the surface that they are no threads. O(n).
Warps warps_of(const Positions& positions, const Triangles& triangles, const CornerUvs& uvs);

/// Unit vector along the warp of a triangle where its corners lie now; zero where it is not known.
Vec3 warp_direction(const GarmentMesh& garment, Eigen::Index triangle);

/// With these of its triangles, in this order, and the positions given.
GarmentMesh with_triangles(const GarmentMesh& garment, Positions positions, const std::vector<int>& triangles);

}  // namespace garmentfit
