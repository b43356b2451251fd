// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "curve_skeleton.h"

namespace garmentfit {

/// A surface that closes over a contact, such as a hand on the hip of a scan, has handles, and its curves have loops.
/// Returns the possible trees after cutting all loops. A short loop, between fingers, is cut in one way. A long one is
/// cut wherever a hand may touch: beside a fork or halfway between two. A tree is returned unchanged. O(loops * edges *
/// nodes).
std::vector<CurveSkeleton> open_loops(const CurveSkeleton& skeleton);

}  // namespace garmentfit
