// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The two meshes that libfit works on, and the functions that check and make them.

#include "garmentfit/export.h"
#include "garmentfit/types.h"

namespace garmentfit {

/// A body: the user's surface, and the repaired closed surface that geometry is measured on.
struct BodyMesh {
    TriangleMesh surface;  ///< every vertex and face as given
    TriangleMesh closed;  ///< a closed, oriented, connected 2-manifold; equal to `surface` where that is one already
    bool repaired = false;  ///< true when `closed` differs from `surface`
};

/// A garment: triangles with or without thickness; borders are allowed.
struct GarmentMesh {
    Positions positions;  ///< n x 3, metres; also the rest shape, which sets edge lengths and folds
    Triangles triangles;
};

/// Checks a body mesh and makes the closed surface: welds, drops islands, fills holes, orients outwards (CGAL).
/// Cost O(n log n). @throws InvalidInput: no faces, not finite, index out of range, nothing that can be closed.
GARMENTFIT_API BodyMesh make_body(const Positions& positions, const Triangles& triangles);

/// Checks a garment mesh. Cost O(n). @throws InvalidInput: no faces, not finite, index out of range, all faces
/// degenerate.
GARMENTFIT_API GarmentMesh make_garment(const Positions& positions, const Triangles& triangles);

/// Unit vertex normals, area weighted, n x 3; zero where a vertex has no face.
GARMENTFIT_API Positions vertex_normals(const Positions& positions, const Triangles& triangles);

/// Each undirected edge once, rows (i, j) with i < j, sorted; k x 2.
GARMENTFIT_API Eigen::Matrix<int, Eigen::Dynamic, 2, Eigen::RowMajor> edges_of(const Triangles& triangles);

}  // namespace garmentfit
