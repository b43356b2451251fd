// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "garmentfit/fit_skeleton.h"

namespace garmentfit {

/// The fast method, told in docs/fit.md.
FitResult fast_fit(const Rig& rig, const GarmentMesh& garment, GarmentType given, const Progress& progress);

}  // namespace garmentfit
