// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "garmentfit/types.h"

namespace garmentfit {

/// Whether a segment and a triangle have a common point, by exact predicates. A segment without length and a triangle
/// without area meet nothing.
bool meets(const Vec3& from, const Vec3& to, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace garmentfit
