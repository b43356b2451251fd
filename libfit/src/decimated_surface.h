// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fit/types.h"

namespace fit {

/// `closed` with edges collapsed (Lindstrom and Turk) until about `vertices` are left; unchanged where it has no more
/// than that already. Stays closed and keeps its genus. O(n log n).
TriangleMesh decimated_surface(const TriangleMesh& closed, int vertices);

}  // namespace fit
