// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "garmentfit/types.h"

namespace garmentfit {

/// Returns a closed, outward oriented, connected 2-manifold near `surface`. Sets `repaired` to whether it differs.
/// @throws InvalidInput when nothing can be closed.
TriangleMesh close_surface(const TriangleMesh& surface, bool& repaired);

struct JoinedParts {
    TriangleMesh closed;
    bool is_wide;  ///< joins what lies further apart than a wrap usually does, such as arms and trunk
};

/// Wraps of a surface in parts as one body, from a narrow wrap, which keeps what is apart, to a wide one, which spans
/// gaps: those whose largest piece holds nearly all of the surface; perhaps none. Some seconds.
std::vector<JoinedParts> join_parts(const TriangleMesh& surface);

}  // namespace garmentfit
