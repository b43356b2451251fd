// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Whether a garment lies round the body in its file: then body and garment are of one frame, and it is worn as it lies.

#include "garmentfit/export.h"
#include "garmentfit/types.h"

namespace garmentfit {

/// Most of its cloth is near the skin, and that is no chance: its middle is not at the origin, where programs put what
/// they write. The body is tried where it is, and with its soles and its pelvis at the origin, as files of avatars and
/// of their clothes have one or the other there.
/// @param garment  m, y up, in the body's unit and axes
GARMENTFIT_API bool lies_on_body(const TriangleMesh& garment, const TriangleMesh& body);

}  // namespace garmentfit
