// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// One sheet of cloth that moves in the place of a garment in many parts or with many vertices, and takes it along.
//
// Method   The stand-in is the inner sheet of an alpha wrap [portaneri_2022_alpha_wrap] round all parts; or, of fine
//          cloth, the cloth in larger triangles [botsch_kobbelt_2004_multiresolution]. Each vertex of the garment goes
//          with the blended motions of the stand-in's vertices near it (embedded deformation
//          [sumner_2007_embedded_deformation]). Where parts that lay side by side then meet or are torn apart, the
//          motions round them are evened: harmonic over the edges of the garment and over links between its sheets.
//          What meets the body is pushed away from it, and what lies beside it goes along; parts that meet each other
//          are parted.
// Units    metres.

#include <optional>
#include <vector>

#include "garmentfit/export.h"
#include "garmentfit/mesh.h"
#include "garmentfit/progress.h"

namespace garmentfit {

struct StandIn {
    GarmentMesh mesh;
    bool is_needed = true;  ///< else the garment may move as it is, which takes longer
    bool is_rough = false;  ///< a garment that followed it is near a rest of its own, and is to find that
};

/// A stand-in, for clothes that cannot be read as one layer of cloth: panels that are closed slabs, sheets that lie on
/// each other, cloth full of borders (docs/decisions/0032-wrapped-garments.md); for clothes with details whose edges
/// are far shorter than those of the cloth, cords, zips and stitches, where contact has hundreds of pairs for a vertex
/// (docs/decisions/0033-stand-ins.md); and, not needed, for cloth of 20,000 vertices and more: the same in larger
/// triangles where it is a manifold and does not cross itself, else the inner sheet of a wrap. For such a manifold of
/// 5,000 vertices and more, in one piece, the same in so few triangles that it is rough. None for all others.
/// Cost: 4 to 8 s where there is a wrap, whatever the size of the garment; else O(n log n).
/// @param garment  on a body of human size
GARMENTFIT_API std::optional<StandIn> make_stand_in(const GarmentMesh& garment);

/// The inner sheet of a wrap round any garment, where a body passes through it. It is not needed.
/// Cost as make_stand_in with a wrap.
GARMENTFIT_API std::optional<StandIn> make_lining(const GarmentMesh& garment);

/// What a garment has to keep clear of.
struct Surroundings {
    TriangleMesh body;  ///< closed
    std::vector<TriangleMesh> clothes = {};  ///< that are worn with it
};

/// Where a garment goes with its stand-in, n x 3. Clear of its surroundings as far as it can be, which a certificate has
/// to tell. Cost O(n log n), and that of untangling.
/// @param stand_in  at rest
/// @param worn      positions of the stand-in
/// @param garment   at rest
/// @param progress  after its deadline, nothing is evened, pushed out or parted any further
/// @throws Cancelled
GARMENTFIT_API Positions follow(const GarmentMesh& stand_in, const Positions& worn, const GarmentMesh& garment,
                                const Surroundings& around, const Progress& progress = {});

/// The same without anything that keeps it clear, for what is only passed through. Cost O(n log n).
GARMENTFIT_API Positions follow_roughly(const GarmentMesh& stand_in, const Positions& worn, const GarmentMesh& garment);

}  // namespace garmentfit
