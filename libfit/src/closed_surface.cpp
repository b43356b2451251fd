// SPDX-License-Identifier: GPL-3.0-or-later
#include "closed_surface.h"

namespace fit {

TriangleMesh closed_surface(const TriangleMesh& surface, bool& repaired)
{
    repaired = false;
    return surface;
}

}  // namespace fit
