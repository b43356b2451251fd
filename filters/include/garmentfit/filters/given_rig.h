// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Whose a rig is that was read from arrays or files.

#include <string>

#include "garmentfit/skeleton.h"

namespace garmentfit {

/// The rig of this body, with the radii measured on it. @throws InvalidInput where it is another body's, or the body was
///         moved since: there are more or fewer vertices, or the skin lies elsewhere about the bones; and where it is no rig
///         at all: weights that do not sum to 1, directions that are none.
/// @param own  the body's positions in its own pose, metres
/// @param called  what the user knows the rig by
Rig rig_on(Rig rig, const Positions& own, const std::string& called = "the rig");

}  // namespace garmentfit
