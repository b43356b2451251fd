// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The tangent stiffness of cloth, simplified so that it is definite and sparse, and its Cholesky factor.
//
// Method  springs keep their stiffness along themselves and, where they are stretched, their tension across; the
//         pressure of compressed ones, which would make the matrix indefinite, is left out [choi_2002_buckling]. Hinges
//         and ties act with their frames held, contacts and strain limits as the linear constraints that they are. What
//         couples two vertices without a common edge or tie is moved to the diagonal, which makes the form larger: it stays
//         definite, and its pattern stays that of the garment. In single precision: it is a preconditioner.
// Units   metres, kilograms, seconds. Positions, forces and displacements are n x 3.

#include <vector>

#include "block_cholesky.h"
#include "cloth_energy.h"
#include "soft_constraint.h"

namespace garmentfit {

class TangentFactor {
public:
    /// Finds the pattern and an order of elimination. Keeps a reference to `energy`.
    explicit TangentFactor(const ClothEnergy& energy);

    /// Takes the tangent at `x` under these constraints, with the inertia of the time step of `energy`, and factorises
    /// it. Where rounding leaves it indefinite, its diagonal grows until it is not. Cost: on a garment of n vertices about
    /// n^1.5; 0.03 s of CPU time at 12,000.
    /// @throws SolverFailure where the matrix is far from positive definite
    void factorise(const Positions& x, const std::vector<SoftConstraint>& constraints);

    /// The displacement whose tangent forces these are.
    Positions solve(const Positions& forces) const;

private:
    template <std::size_t Count>
    void add_outer(const std::array<int, Count>& vertices, const std::array<double, Count>& coefficients,
                   const Eigen::Matrix3d& block);

    const ClothEnergy& energy_;
    BlockCholesky matrix_;
    std::vector<Eigen::Matrix3d> framed_;  // its blocks of hinges and ties alone, which do not change
};

}  // namespace garmentfit
