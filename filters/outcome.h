// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How dressing ended, in a word and in a sentence.

#include <string>
#include <vector>

#include "filters/filters.h"

namespace fit {

/// The values are the command line's exit codes.
enum class Outcome { done = 0, too_small = 3, not_certified = 4 };

/// How the garments are worn at the end, or null when none was put on (yet).
const Dressing* final_dressing(const Scene& scene);
bool all_clean(const std::vector<WornGarment>& garments);
Outcome outcome_of(const Dressing& dressing);
/// One line on how it went wrong; only for what is not done. Garments are called by their `names`, from the inside out.
std::string explain(const Dressing& dressing, const std::vector<std::string>& names);
/// Rounded down: what stopped on its way never says 100%.
int percent(double share);

}  // namespace fit
