// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Nonlinear conjugate gradients (Polak and Ribiere) for one implicit time step of cloth.
//
// Preconditioner  the constant quadratic form of projective dynamics; compare [liu_2017_quasi_newton]. That takes a
//                 third of the triangular solves that a linear system after each projection takes.

#include <vector>

#include "cloth_energy.h"

namespace garmentfit {

/// Minimises inertia (about `inertial`, n x 3), stretch, bend and constraints, from given positions (n x 3).
class PreconditionedCG {
public:
    /// Keeps references to `energy` and `inertial`.
    PreconditionedCG(const ClothEnergy& energy, const Positions& start, const Positions& inertial);

    /// Takes these constraints, and the strain limits and the frames of hinges at the present positions; all of them
    /// hold until the next call. Without a call there are no contact constraints.
    void set_constraints(const std::vector<SoftConstraint>& constraints);
    /// One iteration. The energy does not rise, but for what the turning of hinges adds.
    void iterate();

    const Positions& positions() const { return x_; }

private:
    void update_direction(const Positions& residual);

    const ClothEnergy& energy_;
    const Positions& inertial_;
    std::vector<SoftConstraint> constraints_;
    Positions x_;
    Positions constant_;  // loads of inertia, hinges and constraints
    Positions applied_;  // the constant quadratic form times x_, without constraints
    Positions residual_, direction_;  // of the last iteration
    double square_ = 0;  // of that residual, in the norm of the preconditioner
};

}  // namespace garmentfit
