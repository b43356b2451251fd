// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Smooth weights over a surface, drawn to targets that are more or less certain. After the inpainting of
// [abdrashitov_2023_weights], where targets are either exact or absent.

#include <vector>

#include <Eigen/Core>

#include "garmentfit/mesh.h"
#include "sewn_pieces.h"

namespace garmentfit {

/// The minimiser of w' (L + s^2 L M^-1 L) w + (w - t)' M P (w - t), where L is the cotangent Laplacian, M the areas of the
/// vertices, s `stiff_length`, t the targets and P the pulls. A pull of 1/l^2 smooths targets over the length l. Where
/// there is none, weights are harmonic over lengths above s, and smooth (biharmonic) below it. Pieces that are tied have
/// the same weights at both ends of a tie. Rows may leave [0, 1] a little.
/// @param pulls  of each vertex, 1/m^2; above 0 for at least one of each set of vertices that edges and ties connect
/// @param targets  n x joints
/// @param stiff_length  m, or the unit of `cloth` throughout
/// Cost one sparse factorisation. @throws SolverFailure.
Eigen::MatrixXd inpaint(const GarmentMesh& cloth, const std::vector<Tie>& ties, const Eigen::VectorXd& pulls,
                        const Eigen::MatrixXd& targets, double stiff_length);

}  // namespace garmentfit
