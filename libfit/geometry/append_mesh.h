// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "garmentfit/mesh.h"

namespace garmentfit {

/// Appends `more` to `mesh`, its triangles renumbered.
void append(TriangleMesh& mesh, const TriangleMesh& more);
/// The same of garments. Where one of them has no warps, these are not known there.
void append(GarmentMesh& mesh, const GarmentMesh& more);

}  // namespace garmentfit
