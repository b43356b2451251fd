// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "garmentfit/types.h"

namespace garmentfit {

/// A closed surface shrink-wrapped round any triangles [portaneri_2022_alpha_wrap]; holes narrower than some 1% of the
/// diagonal are wrapped over. A few seconds.
TriangleMesh wrapped_surface(const TriangleMesh& surface);

}  // namespace garmentfit
