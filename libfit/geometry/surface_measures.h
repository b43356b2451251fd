// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "garmentfit/types.h"

namespace garmentfit {

/// m^2. O(n).
double area(const TriangleMesh& mesh);

/// Enclosed by a closed surface, negative where its triangles are turned inwards; m^3. O(n).
double volume(const TriangleMesh& closed);

}  // namespace garmentfit
