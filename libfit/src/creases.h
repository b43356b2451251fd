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

class Creases {
public:
    /// Finds the creases of a surface as it stands (n x 3): vertices that face another part of it without room for cloth
    /// between, or lie inside another part. Cost O(n log n).
    explicit Creases(const TriangleMesh& surface);

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

}  // namespace fit
