// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "garmentfit/mesh.h"

namespace garmentfit {

/// The garment prepared for analysis: equal vertices welded, equal faces dropped, inner sheets of thick cloth removed,
/// and every patch oriented outwards, independent of the orientation of the input. Cost O(n log n).
TriangleMesh outward_cloth(const GarmentMesh& garment);

/// About the origin.
TriangleMesh rotate(TriangleMesh cloth, const Eigen::Quaterniond& turn);

}  // namespace garmentfit
