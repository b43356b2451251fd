// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Newton's method for one implicit time step of cloth. An iteration costs about twenty of conjugate gradients, and gets
// to the end where these do not: over long time steps, near equilibrium.
//
// Units   metres, kilograms, seconds. Positions and forces are n x 3.

#include <functional>
#include <vector>

#include "cloth_energy.h"
#include "soft_constraint.h"

namespace garmentfit {

/// The contact constraints when the cloth is at these positions.
using ConstraintsAt = std::function<std::vector<SoftConstraint>(const Positions&)>;

/// Contacts, and the strain limits of the cloth at x.
std::vector<SoftConstraint> with_strain_limits(const ClothEnergy& energy, const Positions& x,
                                               std::vector<SoftConstraint> contacts);

/// Of springs, hinges, ties and constraints on each vertex, N.
Positions static_forces(const ClothEnergy& energy, const Positions& x, const std::vector<SoftConstraint>& constraints);

/// Where inertia (about `inertial`), cloth and contacts balance, approximately.
/// @param start  of the iterations. A vertex goes k_largest_rest_move at most in each; then all of them go the same
///               share of their way, for cloth of which single vertices are held back is bent and stretched
/// @throws SolverFailure
Positions newton_step(const ClothEnergy& energy, const Positions& start, const Positions& inertial, int iterations,
                      const ConstraintsAt& contacts);

}  // namespace garmentfit
