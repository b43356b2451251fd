// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "garmentfit/types.h"

namespace garmentfit {

/// Appends `more` to `mesh`, its triangles renumbered.
void append(TriangleMesh& mesh, const TriangleMesh& more);

}  // namespace garmentfit
