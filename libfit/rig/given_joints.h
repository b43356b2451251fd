// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "garmentfit/rig_body.h"

namespace garmentfit {

/// Replaces found joints by given ones. Elbows, knees and joints of the spine that were not given keep their position
/// relative to their neighbours. Shoulders, hips, wrists, ankles and tips that were not given stay.
Skeleton correct(const Skeleton& found, const GivenJoints& given);

/// Tips that were not given lie beyond the last joints by the usual length of hands, feet and heads. @pre
/// given.is_complete()
Skeleton skeleton_of(const GivenJoints& given);

}  // namespace garmentfit
