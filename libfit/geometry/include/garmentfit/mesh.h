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

/// How the warp of woven cloth, or the wales of a knit, run in each triangle: a row (s, t) says along
/// s (second - first corner) + t (third - first corner), (0, 0) that it is not known. So it follows when vertices move.
using Warps = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

/// A garment: triangles with or without thickness; borders are allowed.
struct GarmentMesh {
    Positions positions;  ///< n x 3, metres; also the rest shape, which sets edge lengths and folds
    Triangles triangles;
    Warps warps = {};  ///< one row for each triangle; no rows: the cloth is alike in all directions
};

/// Checks a body mesh and makes the closed surface: welds, drops islands, fills holes, orients outwards (CGAL).
/// Cost O(n log n). @throws InvalidInput: no faces, not finite, index out of range, nothing that can be closed.
GARMENTFIT_API BodyMesh make_body(const Positions& positions, const Triangles& triangles);

/// Checks a garment mesh. Cost O(n). @throws InvalidInput: no faces, not finite, index out of range, all faces
/// degenerate.
/// @param uvs  where the triangles lie in the pieces that cloth is cut into: v runs along the warp, u along the weft. They
///             do not count where u and v meet so askew on the surface that they are no threads (docs/fabrics.md).
GARMENTFIT_API GarmentMesh make_garment(const Positions& positions, const Triangles& triangles,
                                        const CornerUvs& uvs = {});

/// Unit vertex normals, area weighted, n x 3; zero where a vertex has no face.
GARMENTFIT_API Positions vertex_normals(const Positions& positions, const Triangles& triangles);

/// Each undirected edge once, rows (i, j) with i < j, sorted; k x 2.
GARMENTFIT_API Eigen::Matrix<int, Eigen::Dynamic, 2, Eigen::RowMajor> edges_of(const Triangles& triangles);

}  // namespace garmentfit
