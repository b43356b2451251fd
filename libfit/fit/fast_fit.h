// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "garmentfit/fit_skeleton.h"

namespace garmentfit {

/// The fast method (docs/fit.md).
FitResult fit_fast(const Rig& rig, const TriangleMesh& body, const GarmentMesh& garment, const FitOptions& options,
                   const Progress& progress);

}  // namespace garmentfit
