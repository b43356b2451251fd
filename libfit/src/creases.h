// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where a body touches or enters itself there is no room for cloth: armpits, crooks of elbows and knees, groins.
//
// While a body moves such creases are bridged by a membrane, so that cloth slides over them and is not caught inside;
// at the end the membrane retreats into the crease, away from the cloth, which nothing can hinder.

#include <Eigen/SparseCholesky>
#include <vector>

#include "fit/types.h"

namespace fit {

/// How far, along edges, the sides of a crease are part of it from where it is shut: where its membrane begins, cloth must find room
/// again. In square roots of the body's area, which no pose changes: 3 and 9 cm for an adult.
constexpr double k_narrow_side = 0.023, k_wide_side = 0.067;

class Creases {
public:
    /// Finds the creases of a surface as it stands (n x 3): vertices that face another part of it without room for cloth
    /// between, or lie inside another part. Cost O(n log n).
    /// @param near_cloth  of each vertex; creases without any such vertex (a mouth, say, or toes) are left alone
    Creases(const TriangleMesh& surface, const std::vector<char>& near_cloth, double side = k_narrow_side);

    /// The surface, in any pose (n x 3), with its creases bridged: each crease is a harmonic membrane over its border.
    Positions bridged(const Positions& positions) const;

    /// The surface with what is in creases pulled halfway to `core`, where it collapses to: inside the body, where no cloth
    /// is. From a bridge into its crease the skin goes by way of this.
    Positions withdrawn(const Positions& positions, const Positions& core) const;

private:
    std::vector<int> inner_;  // vertices of the creases
    Eigen::SparseMatrix<double> to_border_;  // couples inner vertices to the fixed ones
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> membrane_;
};

/// Whether cloth (m x 3) is so near to each point of a body (n x 3, as it wears it) that it may get into creases there. O((n + m) log m).
std::vector<char> near_cloth(const Positions& body, const Positions& cloth);

}  // namespace fit
