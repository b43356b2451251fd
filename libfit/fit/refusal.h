// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Why no body fits into a garment, in one line that says what to do. Sizes are shares of the body's: the fit knows no
// file's unit.

#include "garmentfit/error.h"
#include "garmentfit/fit_skeleton.h"
#include "hypotheses.h"

namespace garmentfit {

/// Of a body if it stood upright, from ankles to top of the head, m. A little too much: the bones of the hips lie
/// aslant.
double standing_height(const Skeleton& joints);

/// How much taller than this body those are whom the parts of the garment would fit: the median over its shoulders,
/// sleeves, trunk and legs. None where no part is found.
std::optional<double> wearer_share(const Skeleton& joints, const std::vector<Opening>& openings);

/// Of a garment in which no body fits in any way that was looked at. The first that holds is said: a wrong unit; the
/// place, the front or the type that the user gave; too small; or else what hinders the most probable way.
/// @param best  the most probable way of wearing it
InvalidInput refusal_of(const Hypothesis& best, const FitOptions& options);

/// Of trousers in a pose with no leg of the body inside.
InvalidInput refusal_of_empty_legs();

}  // namespace garmentfit
