// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The second choice: other ways of wearing a garment, where the most probable one ends badly.

#include <functional>

#include "garmentfit/filters/filters.h"

namespace garmentfit {

/// How to dress a scene that has its rig.
struct DressingSteps {
    std::function<void(Scene&)> fit, drape_and_recover;
};

/// Where a garment is too small, crosses, is held back or torn, the next probable ways of wearing it are tried, and the
/// scene keeps the best outcome. What was tried in vain is added to FitResult::rejected.
void try_other_wearings(Scene& scene, const DressingSteps& steps, const Progress& progress);

}  // namespace garmentfit
