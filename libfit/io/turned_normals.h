// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "garmentfit/types.h"

namespace garmentfit {

/// Turns a file's normals with its surface: each by the rotation that takes the mean normal of the faces that use it
/// from before to after. Hard edges stay hard. A normal whose faces did not turn keeps its bits. `corners` holds the
/// row of the normal at each corner of `triangles`, or -1; it is `triangles` itself where normals belong to vertices.
/// O(n).
Positions turn_normals(const Positions& normals, const Triangles& corners, const Triangles& triangles,
                       const Positions& before, const Positions& after);

/// Of the area of corners with a normal, the share whose normals point against the winding of their faces; 0 without
/// normals. O(n).
double share_against_faces(const Positions& normals, const Triangles& corners, const Triangles& triangles,
                           const Positions& positions);

}  // namespace garmentfit
