// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "garmentfit/mesh.h"

namespace garmentfit {

/// The garment as the fit looks at it: equal vertices welded, equal faces dropped, and every patch turned outwards whatever
/// way its faces were given. Cost O(n log n).
TriangleMesh outward_cloth(const GarmentMesh& garment);

TriangleMesh turned(TriangleMesh cloth, const Eigen::Quaterniond& turn);

}  // namespace garmentfit
