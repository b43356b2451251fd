// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "garmentfit/progress.h"
#include "garmentfit/types.h"

namespace garmentfit {

/// Returns a closed, outward oriented, connected 2-manifold near `surface`. Sets `repaired` to whether it differs.
/// @throws InvalidInput when nothing can be closed.
TriangleMesh close_surface(const TriangleMesh& surface, bool& repaired);

/// What a wrap of a body in parts spans: little, so that arms stay off the trunk, or also what lies further apart.
enum class Gaps { narrow, wide };

/// Wraps a surface in parts as one body. Nothing where the largest piece of the wrap does not hold nearly all of the
/// surface, or where folds and layers give the wrap far more points than a body has. Up to a second for wide gaps, ten
/// for narrow ones. @throws as `progress`
std::optional<TriangleMesh> join_parts(const TriangleMesh& surface, Gaps gaps, const Progress& progress = {});

}  // namespace garmentfit
