// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

struct aiScene;

namespace garmentfit {

/// Leaves out coarser levels of detail. Files for games show a mesh several times at one place, with fewer triangles
/// each time, as shirt_LOD0, shirt_LOD1 and so on; engines draw one of them, by its distance. The finest level of each
/// name stays, and so does what has a level, but no finer one.
void keep_finest_levels(aiScene& scene);

}  // namespace garmentfit
