// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "garmentfit/rig_body.h"

namespace garmentfit {

/// Puts given joints in place. Elbows, knees and the joints of the spine that were not given keep their place between
/// their neighbours; shoulders, hips, wrists, ankles and tips that were not given stay where they were found.
Skeleton correct(const Skeleton& found, const GivenJoints& given);

/// @pre given.complete(). Tips that were not given lie as far beyond the last joints as hands, feet and heads are long.
Skeleton skeleton_of(const GivenJoints& given);

}  // namespace garmentfit
