// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Whole postures, and moves of their trunk and limbs.

#include <vector>

#include "clearance_search.h"
#include "fit_energy.h"

namespace garmentfit {

/// The body in comfort, turned by `turn`, its root at `root`.
Posture comfort_posture(const FitEnergy& energy, const Vec3& root, const Eigen::Quaterniond& turn);

/// The body as it was given.
Posture input_posture(const Skeleton& rest, const Vec3& shift = Vec3::Zero());

/// The best places of the root, where the trunk has most clearance in this posture. The posture's own root does not
/// count.
std::vector<Place> find_trunk_places(const FitEnergy& energy, const MinMaxPyramid& clearance, const Posture& posture);

/// The body rotated about the middle of its trunk.
Posture rotate_about_trunk(const FitEnergy& energy, const Posture& present, const Vec3& rotation_vector);

/// The limb as its twin is held.
Posture mirror_limb(const Rig& rig, const Posture& present, const Limb& limb);

}  // namespace garmentfit
