// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "garmentfit/types.h"

namespace garmentfit {

/// One closed, outward oriented, connected 2-manifold near `surface`; `repaired` says whether it differs from it.
/// @throws InvalidInput when nothing can be closed.
TriangleMesh closed_surface(const TriangleMesh& surface, bool& repaired);

}  // namespace garmentfit
