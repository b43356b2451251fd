// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "garmentfit/types.h"

namespace garmentfit {

/// Collapses the shortest edges of a closed manifold to their middles, evenly all over, until about `vertices` are
/// left, or up to a third fewer. The result is a closed manifold, and no triangle turns over. O(n), a microsecond a
/// vertex.
TriangleMesh collapse_short_edges(const TriangleMesh& closed, int vertices);

}  // namespace garmentfit
