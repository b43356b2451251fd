// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "garmentfit/types.h"

namespace garmentfit {

/// `closed` with about `vertices` vertices: edges collapsed (Lindstrom and Turk) where it has more; triangles quartered
/// where it has less than a third of that, for a curve skeleton needs vertices to contract. Stays closed and keeps its genus.
/// O(n log n).
TriangleMesh proxy_surface(const TriangleMesh& closed, int vertices);

}  // namespace garmentfit
