// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "garmentfit/recover_pose.h"

namespace garmentfit {

/// Lets a body go from where it is near its pose to its place there, and the garments find their rest on it, as
/// recover_pose does at the end of its path. `options.settling_steps`, frames and steps do not count.
/// @pre nothing crosses the body where it is
RecoverResult rest_on_body(const Rig& rig, const BodyMesh& body, const DressedBody& dressed, RecoverOptions options,
                           const Progress& progress);

}  // namespace garmentfit
