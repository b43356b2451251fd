// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The elastic energy of a garment, in the form of projective dynamics [bouaziz_2014_projective_dynamics]: a constant
// quadratic form minus what springs and hinges, each projected to its own rest, pull with (their loads).
//
// Stretch  a spring along each edge, with its rest length. Beyond a limit it is stiffer; [provot_1995_cloth] moves
//          such edges back instead.
// Bend     quadratic hinges [bergou_2006_quadratic_bending] that keep the mean curvature vector they have at rest,
//          turned along with the hinge, so a garment keeps its own folds.
// Units    metres, kilograms, seconds. Positions and forces are n x 3.

#include <Eigen/SparseCore>
#include <array>
#include <utility>
#include <vector>

#include "garmentfit/cloth.h"
#include "garmentfit/mesh.h"
#include "single_precision_factor.h"
#include "soft_constraint.h"
#include "topology.h"

namespace garmentfit {

class ClothEnergy {
public:
    /// @param topology  of rest.triangles
    /// @param ties      pairs of vertices held at their rest distance, beside the edges
    ClothEnergy(const GarmentMesh& rest, const MeshTopology& topology, const std::vector<std::pair<int, int>>& ties,
                const ClothOptions& options);

    /// Seconds. Each new one costs one factorisation, of everything but the constraints.
    void set_time_step(double time_step);

    /// Of springs and hinges, J; without strain limits.
    double elastic_energy(const Positions& x) const;
    /// Minus the gradient of that energy, N, with the frames of the hinges held.
    Positions elastic_forces(const Positions& x) const;
    const std::vector<double>& masses() const { return masses_; }  ///< kg

    // ---- the parts of the implicit time step, for its solver ----

    double inertia() const { return inertia_; }  ///< 1 / h^2 of the time step h, 1/s^2
    /// The loads of springs and hinges when they are projected to their rest, N.
    Positions spring_loads(const Positions& x) const;
    Positions hinge_loads(const Positions& x) const;
    /// The constant quadratic form (inertia, springs, hinges) times x, N.
    Positions apply_quadratic_form(const Positions& x) const;
    /// Approximately the inverse of that form times the residual, in single precision.
    Positions precondition(const Positions& residual) const { return factor_.solve(residual); }
    /// A constraint for each edge that is stretched beyond the limit.
    std::vector<SoftConstraint> strain_limits(const Positions& x) const;

private:
    using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;
    struct Spring {
        int i, j;
        double length, stiffness;
    };
    struct Hinge {
        std::array<int, 4> v;  // the shared edge, then the opposite corners
        std::array<double, 4> coefficients;  // their weighted sum is the mean curvature vector of the hinge
        Vec3 curvature;  // that vector at rest, in the hinge's own frame
        double stiffness;
    };
    void add_springs(const GarmentMesh& rest, const MeshTopology& topology,
                     const std::vector<std::pair<int, int>>& ties, const Material& material);
    void add_hinges(const GarmentMesh& rest, const MeshTopology& topology, double bend_stiffness);
    void assemble();
    static Positions multiply(const SparseRows& matrix, const Positions& x);

    std::vector<double> masses_;
    std::vector<Spring> springs_;
    std::vector<Hinge> hinges_;
    SparseRows spring_gradients_, hinge_gradients_;  // n x elements: how their loads act on the vertices
    SparseRows elastic_;  // constant part of the system, n x n, both triangles
    SinglePrecisionFactor factor_;
    double inertia_ = 0;
};

}  // namespace garmentfit
