// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "garmentfit/types.h"

namespace garmentfit {

/// Turns a file's normals along with its surface: each by the rotation that takes the mean normal of the faces that use it,
/// before, to that after. Hard edges stay hard, and a normal whose faces did not turn comes back bit for bit.
/// `corners` names the normal at each corner of `triangles`, -1 = none; other rows are `triangles` itself where normals
/// belong to vertices. O(n).
Positions turned_normals(const Positions& normals, const Triangles& corners, const Triangles& triangles,
                         const Positions& before, const Positions& after);

}  // namespace garmentfit
