// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Pieces in a garment's mesh that are no cloth. Shops' viewers look into a garment from outside, so its inside is
// hidden there: by a solid in the shape of a trunk, or by lids that lie loosely in the openings. Specks are left over
// from modelling, far from all cloth; backdrops from taking a picture.

#include <vector>

#include "garmentfit/types.h"
#include "topology.h"

namespace garmentfit {

/// Faces that are connected through edges of exactly two faces, for each such patch.
std::vector<std::vector<int>> patches_of(const MeshTopology& topology, int faces);

/// Whether no vertex lies within a disc: its faces, which only share edges from rim to rim, are a tree.
bool is_without_inner_vertices(const MeshTopology& topology, const std::vector<int>& disc);

/// Solids inside the cloth: patches without open edge and tunnel that are not thin, of some size, and reach beyond the
/// rest of the mesh nowhere. No body passes through one.
/// @param closed_ends  caps of each patch: one with three or more is a garment with closed ends
std::vector<std::vector<int>> find_fillings(const TriangleMesh& mesh, const MeshTopology& topology,
                                            const std::vector<std::vector<int>>& patches,
                                            const std::vector<int>& closed_ends);

/// Small patches that are farther from the garment's large ones than they are long. Nothing holds them, and a body may be
/// where they are.
std::vector<std::vector<int>> find_specks(const TriangleMesh& mesh, const std::vector<std::vector<int>>& patches);

/// Flat patches that are larger than all others together; else one that lies apart from all others, on one side of them:
/// a floor, or a shadow on it.
std::vector<std::vector<int>> find_backdrops(const TriangleMesh& mesh, const std::vector<std::vector<int>>& patches);

/// Lids: flat patches, sheets or slabs, whose rims lie at steep cloth, and whose middles are far from any. Those of many
/// triangles from rim to rim may be as crumpled as the cuff that they close.
/// @param is_cloth  whether a face is not yet known to be none
std::vector<std::vector<int>> find_lids(const TriangleMesh& mesh, const MeshTopology& topology,
                                        const std::vector<std::vector<int>>& patches,
                                        const std::vector<char>& is_cloth);

}  // namespace garmentfit
