// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "garmentfit/types.h"

namespace garmentfit {

/// Returns a closed surface around any triangles [portaneri_2022_alpha_wrap]. It spans holes narrower than about
/// twice `alpha`, and keeps `offset` off the triangles, both shares of the diagonal. Takes a few seconds.
TriangleMesh wrap_surface(const TriangleMesh& surface, double alpha, double offset);

}  // namespace garmentfit
