// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Patches of a garment: what is connected through edges of exactly two faces. What they enclose tells which side is
// out, and which are cloth with thickness.

#include <utility>
#include <vector>

#include "garmentfit/mesh.h"
#include "topology.h"
#include "tuning.h"

namespace garmentfit {

/// Faces connected through edges of exactly two faces, oriented consistently with the first face.
struct Patch {
    std::vector<int> faces;
    std::vector<std::pair<int, int>> border;  ///< directed as in its faces
    double volume = 0, area = 0;  ///< m^3, each opening closed by a fan to its centroid; m^2
};

/// All patches. Turns the faces of each as its first one is turned. O(n).
std::vector<Patch> collect_patches(TriangleMesh& cloth);

/// Patches that enclose a volume are oriented by its sign, flat ones by the winding number of the others.
void orient_outwards(TriangleMesh& cloth, const std::vector<Patch>& patches);

/// m, of a closed patch.
double thickness_of(const Patch& patch);

/// Keeps the outer sheets of cloth with thickness, so that a garment looks the same with and without thickness: of each
/// patch that is closed, has tunnels, and has its two sheets no farther apart than padding, or `thickest`.
/// @param thickest  share of the root of the patch's area
TriangleMesh drop_inner_sheets(const TriangleMesh& cloth, const std::vector<Patch>& patches,
                               double thickest = garment_tuning::k_thickest);

/// Whether a patch is closed as a sphere is, but for short slits along which it touches itself: panels that a program
/// for patterns sewed edge to edge touch along parts of their rims.
bool is_closed_panel(const Patch& patch, const TriangleMesh& cloth);

/// Half-edge k of face f has number 3 f + k. The other half-edge between the same vertices; -1 if there is none or more
/// than one.
std::vector<int> opposite_edges(const Triangles& triangles, int vertices);

/// Merges equal vertices; the first vertex of each cell replaces the others. Drops vertices without a face.
TriangleMesh weld_vertices(const GarmentMesh& garment);

/// Closes each opening with a fan around its middle.
TriangleMesh fill_openings(TriangleMesh cloth);

/// m, round a border that passes these vertices in turn.
double girth_of(const Positions& positions, const std::vector<int>& loop);

/// m, of all borders.
double border_length(const Positions& positions, const MeshTopology& topology);

}  // namespace garmentfit
