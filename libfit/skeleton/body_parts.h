// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The parts of a body by the names that people use: what a report says.

#include "garmentfit/skeleton.h"

namespace garmentfit {

constexpr int k_body_parts = 14;

/// @return in [0, k_body_parts), or -1 for a bone that no part is named after
int part_of(int bone);
const char* part_name(int part);

}  // namespace garmentfit
