// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Checks that a rig read from arrays or files belongs to a body.

#include <string>

#include "garmentfit/mesh.h"
#include "garmentfit/skeleton.h"

namespace garmentfit {

/// The rig with the radii measured on this body.
/// @throws InvalidInput rig_mismatch: the rig is another body's, or the body was moved since; the numbers of vertices
///         differ, or the distances of the skin to the bones. bad_rig: weights do not sum to 1, or directions are not
///         unit vectors.
/// @param own  the body's positions in its input pose, metres
/// @param called  the rig's name in messages
Rig rig_on(Rig rig, const Positions& own, const std::string& called = "the rig");

/// Why a rig that a user gave may be wrong for the body: the line of check_skeleton(); empty where nothing speaks
/// against it. The user may know better: a body may have lost a forearm.
std::string doubt_about(const Rig& rig, const BodyMesh& body);

}  // namespace garmentfit
