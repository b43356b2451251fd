// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Everyday names of body parts, for reports.

#include "garmentfit/skeleton.h"

namespace garmentfit {

constexpr int k_body_parts = 14;  // derived: rows of the table in body_parts.cpp

/// @return in [0, k_body_parts); -1 for a bone that belongs to no named part
int part_of(int bone);
const char* part_name(int part);

}  // namespace garmentfit
