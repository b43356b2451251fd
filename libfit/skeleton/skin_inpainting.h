// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Fills weights in over a surface from the vertices whose weights are known [abdrashitov_2023_weights].

#include <vector>

#include <Eigen/Core>

#include "garmentfit/mesh.h"
#include "sewn_pieces.h"

namespace garmentfit {

/// Sets the rows that are not known to the minimiser of w' (L + s^2 L M^-1 L) w, where L is the cotangent Laplacian, M
/// the areas of the vertices and s `stiff_length`: harmonic over lengths above s, and smooth (biharmonic) below it.
/// Pieces that are tied have the same weights at both ends of a tie. Rows may leave [0, 1] a little.
/// @param is_known  of each vertex; at least one of each set of vertices that edges and ties connect
/// @param weights   n x joints; rows that are not known are overwritten
/// @param stiff_length  in the unit of `cloth`
/// Cost one sparse factorisation of the unknown rows. @throws SolverFailure.
void inpaint(const GarmentMesh& cloth, const std::vector<Tie>& ties, const std::vector<char>& is_known,
             double stiff_length, Eigen::MatrixXd& weights);

}  // namespace garmentfit
