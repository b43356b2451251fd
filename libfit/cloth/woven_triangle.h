// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A triangle of cloth whose warp and weft are known: an orthotropic sheet, strained alike all over. Its strain is told by
// how much longer its three sides are, so its energy is a quadratic form of their lengthening: springs along the sides
// that pull on each other, as [delingette_2008_triangular_springs] has it for isotropic sheets and squared lengths. So the
// sheet follows from no direction of the mesh.

#include <Eigen/Core>
#include <optional>

#include "garmentfit/cloth.h"
#include "garmentfit/mesh.h"

namespace garmentfit {

/// Stiffness matrix of a triangle, N/m: the tensions of its sides (first to second corner, second to third, third to
/// first) are this times their lengthening. Symmetric, positive definite. None where the warp is not known, or the
/// triangle is too thin to tell its strain from its sides.
std::optional<Eigen::Matrix3d> woven_triangle(const GarmentMesh& rest, Eigen::Index triangle, const Material& material);

}  // namespace garmentfit
