// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Garments whose cuffs, ankles, neck or hem are closed, by flat caps or by cloth that is modelled all the way round,
// and what lies in them that is no cloth.

#include "garmentfit/export.h"
#include "garmentfit/mesh.h"

namespace garmentfit {

/// Pieces of a garment's mesh that are no cloth of it, and share no vertex with it.
struct LeftOut {
    int garments = 0;  ///< that stand beside it
    int solids = 0;  ///< that fill it
    int lids = 0;  ///< that lie loosely in its openings
    int specks = 0;  ///< small pieces far from all cloth
    int backdrops = 0;  ///< what is larger than it and flat, or apart from it: floors, plinths
    int faces = 0;  ///< of all of them
};

struct OpenedGarment {
    /// All vertices in their order, and the faces of the cloth in theirs. The vertices of each piece of `left_out` lie
    /// in one place, that of the vertex of the cloth nearest to its middle: they go where the cloth goes. So does each
    /// vertex of the floor of a hollow, but for solids.
    GarmentMesh garment;
    int closed_ends = 0;  ///< caps, lids and floors of hollows
    LeftOut left_out = {};
    /// Of what is modelled as a solid, with hollows for openings: its outside without them, one layer of cloth in even
    /// triangles. No faces for others.
    TriangleMesh outside = {};
};

/// Leaves out the caps: flat discs with steep cloth all around them, and flat fans around a vertex; and lids and solids
/// that hide the inside of the garment. Of whole garments that stand side by side, the largest is the one. A surface
/// that is closed everywhere keeps its caps unless they are three or more: a sphere, a block or a pillow is no garment.
/// Where no body passes after that, the floors of its hollows are left out, too: of cuffs, ankles, hems and
/// necks that end in bowls, domes or funnels, and of solids; and those of both sleeves where hem and neck are open.
/// Any size: lengths are judged by the garment's own. Cost O(n log n); with hollows, and for clothes in parts, the
/// seconds of a wrap, once for a garment that was asked for lately.
GARMENTFIT_API OpenedGarment open_ends(const GarmentMesh& garment);

/// The faces without specks and backdrops, each once, in their order: what a garment's size and place are judged by.
/// Cost O(n log n).
GARMENTFIT_API Triangles without_scenery(const GarmentMesh& garment);

}  // namespace garmentfit
