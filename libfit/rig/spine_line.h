// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The middle of the trunk, from the pelvis to the crown.

#include "centreline.h"
#include "joint_labels.h"
#include "labelled_surface.h"

namespace garmentfit {

/// From the pelvis through the centroids of cuts of the trunk to the top of the head's curve. Where the arms leave the
/// trunk, cuts are not free and are ignored. @param up  of the trunk, unit
Centreline trace_spine(const LabelledSurface& surface, const Slicer& slicer, const Vec3& pelvis, const Vec3& up);

/// The highest skin of the head, or of the trunk where there is no head.
Vec3 find_crown(const LabelledSurface& surface, const Vec3& up);

/// Three bones of equal length along the line from pelvis to neck.
void place_back(const Centreline& spine, BodyJoints& joints);

}  // namespace garmentfit
