// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "garmentfit/types.h"

namespace garmentfit {

/// `closed` with about `vertices` vertices. With more, edges are collapsed (Lindstrom and Turk, by CGAL). With fewer
/// than k_fewest_proxy_vertices of them, triangles are quartered: a curve skeleton needs vertices to contract. The
/// result is closed and of the same genus. O(n log n).
TriangleMesh proxy_surface(const TriangleMesh& closed, int vertices);

}  // namespace garmentfit
