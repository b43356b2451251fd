// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "garmentfit/types.h"

namespace garmentfit {

/// The same surface in even triangles [botsch_kobbelt_2004_multiresolution] of about `vertices`, without pieces that are
/// no larger than some of these. None where it is no oriented manifold, or where nothing is left. The result may cross
/// itself in folds narrower than its edges. Cost O(n), ten microseconds a vertex (CGAL).
std::optional<TriangleMesh> remeshed_cloth(const TriangleMesh& cloth, int vertices);

}  // namespace garmentfit
