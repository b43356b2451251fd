// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Cloth with thickness, whose sides and rims are flat and close no opening.

#include <vector>

#include "garmentfit/types.h"
#include "topology.h"

namespace garmentfit {

/// Whether each face belongs to cloth with thickness: a thin closed piece with tunnels, which are its openings, or a
/// panel, like a sphere, with less than half of the cloth.
std::vector<char> mark_thick_cloth(const TriangleMesh& mesh, const MeshTopology& topology);

}  // namespace garmentfit
