// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Inexact Newton directions [nocedal_2006_optimization], chapter 7.1: the tangent stiffness of cloth with all that couples
// in it, by conjugate gradients whose preconditioner is the simplified factor.
//
// Units   metres, newtons. Positions and forces are n x 3.

#include <vector>

#include "tangent_factor.h"

namespace garmentfit {

/// The displacement from x in which these forces should vanish, to within k_newton_tolerance of them in the norm of the
/// factor. Cost: one triangular solve an iteration, of which there are k_newton_iterations at most.
/// @param factor  of the tangent here or near here
Positions newton_direction(const ClothEnergy& energy, const TangentFactor& factor, const Positions& x,
                           const std::vector<SoftConstraint>& constraints, const Positions& forces);

}  // namespace garmentfit
