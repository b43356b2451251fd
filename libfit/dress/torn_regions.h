// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where cloth is led apart that hangs together.

#include <vector>

#include "embedded_motion.h"
#include "topology.h"

namespace garmentfit {

/// Whether an edge between two vertices grows far longer than cloth does.
bool is_torn(const Positions& rest, const Positions& worn, int a, int b);

/// Of each vertex whether most of the cloth round it, within k_cloth_around over the cloth, would take it elsewhere,
/// where there are tears. Looked at in patches of k_patch. O(n log n).
/// @param topology  of the cloth
std::vector<char> find_torn_off(const TriangleMesh& rest, const LedPlaces& led, const MeshTopology& topology);

}  // namespace garmentfit
