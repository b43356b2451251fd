// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// More triangles for a body of few large ones.
//
// Method  Edges are halved that are longer than others of their triangles and longer than the skin of a person bends
//         over [rivara_1984_refinement]. The surface stays as it is in the input pose; in others it bends where limbs
//         do, while a large triangle between an arm and the trunk would stand across the armpit
//         (docs/decisions/0054-refined-bodies.md).
// Cost    O(n log n) for n vertices of the refined body.

#include "garmentfit/mesh.h"
#include "garmentfit/skeleton.h"

namespace garmentfit {

/// Whether half of the surface or more is made of large triangles, on a body of human size.
GARMENTFIT_API bool has_large_triangles(const BodyMesh& body);

/// Whether half of it or more is made of triangles that refining divides.
GARMENTFIT_API bool has_triangles_to_refine(const BodyMesh& body);

struct RiggedBody {
    BodyMesh body;
    Rig rig;
};

/// The same surface with more vertices: first all of the body's, then those halfway between two others, with the mean
/// of their skin weights.
GARMENTFIT_API RiggedBody refine_body(const BodyMesh& body, const Rig& rig);

}  // namespace garmentfit
