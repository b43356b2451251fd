// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The linear system of one Newton iteration of an implicit time step of cloth, and its solution.
//
// Method  springs keep their stiffness along themselves and, where they are stretched, their tension across; the
//         pressure of compressed ones, which would make the system indefinite, is left out [choi_2002_buckling]. Hinges
//         and ties act with their frames held, contacts and strain limits as the linear constraints that they are.
//         Conjugate gradients solve the system. Their preconditioner is a sparse Cholesky factor of the system with
//         hinges that act along edges only: it fills in half as much, and takes a quarter of the time.
// Units   metres, kilograms, seconds. Positions, forces and displacements are n x 3.

#include <Eigen/SparseCholesky>
#include <vector>

#include "cloth_energy.h"
#include "soft_constraint.h"

namespace garmentfit {

class TangentSystem {
public:
    /// Takes the tangent at `x` under these constraints, with the time step of `energy`, and factorises it. Keeps a
    /// reference to `energy`. Cost: on a garment of n vertices about n^1.5, 0.2 s at 12,000.
    /// @throws SolverFailure where the system is not positive definite
    TangentSystem(const ClothEnergy& energy, const Positions& x, const std::vector<SoftConstraint>& constraints);

    /// The displacement whose tangent forces are `forces`, but for a share `tolerance` of their norm.
    Positions solve(const Positions& forces, double tolerance) const;

    /// The tangent forces of a displacement.
    Positions multiply(const Positions& displacement) const;

private:
    Positions precondition(const Positions& forces) const;

    const ClothEnergy& energy_;
    const std::vector<SoftConstraint> constraints_;
    std::vector<Eigen::Matrix3d> spring_tangents_;
    Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factor_;
};

}  // namespace garmentfit
