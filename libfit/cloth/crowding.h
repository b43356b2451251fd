// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "garmentfit/mesh.h"

namespace garmentfit {

/// How many other vertices share a cube with a vertex, on the mean, whose side is the distance at which contact of cloth
/// with cloth is watched: next to none in even cloth, however fine; many where details have edges far shorter than the
/// cloth. The pairs to be watched, and with them seconds and memory, grow with it. Cost O(n log n).
/// @param garment  m on a body of human size
double crowding(const GarmentMesh& garment);

}  // namespace garmentfit
