// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "garmentfit/types.h"

namespace garmentfit {

/// Returns a closed, outward oriented, connected 2-manifold near `surface`. Sets `repaired` to whether it differs.
/// @throws InvalidInput when nothing can be closed.
TriangleMesh close_surface(const TriangleMesh& surface, bool& repaired);

}  // namespace garmentfit
