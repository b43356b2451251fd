// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "garmentfit/types.h"

namespace garmentfit {

/// Collapses the shortest edges of a closed manifold to their middles, evenly all over, until no more than about so many
/// vertices are left; fewer by up to a third. Stays closed and a manifold; no triangle turns over. O(n), a microsecond a vertex.
TriangleMesh without_short_edges(const TriangleMesh& closed, int vertices);

}  // namespace garmentfit
