// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "curve_skeleton.h"

namespace garmentfit {

/// A surface that closes over a contact (a hand on the hip of a scan) has handles, and its curves have loops. Gives the
/// ways to cut them all open, each a tree: short loops, between fingers, in one way only; long ones wherever a hand may
/// touch, that is beside a fork or halfway between two. A tree is its own only way. O(loops * edges * nodes).
std::vector<CurveSkeleton> open_loops(const CurveSkeleton& skeleton);

}  // namespace garmentfit
