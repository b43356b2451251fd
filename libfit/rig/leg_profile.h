// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Front and back of legs seen from the side: buttocks lie behind the thighs, calves behind the shins. Neither needs a
// head, hands or feet.

#include <array>

#include "joint_labels.h"
#include "labelled_surface.h"

namespace garmentfit {

/// How far a leg's outline from the side bows forwards, shares of the bones' lengths, as far as hip and knee are
/// straight: bent ones move flesh, and are evidence of their own. 0 where the skin does not show.
struct LegBows {
    double thigh = 0;  ///< the thigh before its upper end, to which the buttock belongs
    double shin = 0;  ///< the middle of the shin before its ends; calves make it negative
};

/// @param leg  row of BodyJoints::legs. @param front  of the trunk, unit; bows change their sign with it
LegBows leg_bows(const LabelledSurface& surface, const Slicer& slicer, const BodyJoints& joints, int leg,
                 const Vec3& front);

/// @return twice the probability that the bows were measured towards the front, minus 1: from -1 to 1
double certainty_of_front(const std::array<LegBows, 2>& bows);

/// Points forwards, by the profile of both legs; its length is the certainty, 0 to 1.
Vec3 front_of_legs(const LabelledSurface& surface, const Slicer& slicer, const BodyJoints& joints);

}  // namespace garmentfit
