// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "garmentfit/fit_skeleton.h"

namespace garmentfit {

/// The published methods: the paper's [wu_2018_garment_fitting] and Tisserand's [tisserand_2017_garment_positioning].
/// @param body  the surface that was rigged; only tisserand reads it
/// @throws InvalidInput when tisserand gets no such body.
FitResult fit_baseline(const Rig& rig, const TriangleMesh& body, const GarmentMesh& garment, const FitOptions& options,
                       const Progress& progress);

}  // namespace garmentfit
