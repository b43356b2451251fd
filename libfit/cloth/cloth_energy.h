// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The elastic energy of a garment, in the form of projective dynamics [bouaziz_2014_projective_dynamics]: a constant
// quadratic form minus what springs and hinges, each projected to its own rest, pull with (their loads).
//
// Stretch  a spring along each edge, with its rest length. Beyond a limit it is stiffer; [provot_1995_cloth] moves
//          such edges back instead. Where warp and weft are known, springs of one triangle pull on each other
//          (woven_triangle.h). The constant form has more than that, so that it bounds the energy: the loads take off
//          the slack between the two.
// Bend     quadratic hinges [bergou_2006_quadratic_bending] that keep the mean curvature vector they have at rest,
//          turned along with the hinge, so a garment keeps its own folds.
// Sewn     a vertex of a sewn piece wants its place at rest over the triangle that it is tied to, turned along with the
//          triangle. That holds it in all directions, where springs to the corners hold it only along the triangle.
// Units    metres, kilograms, seconds. Positions and forces are n x 3.

#include <Eigen/SparseCore>
#include <array>
#include <utility>
#include <vector>

#include "garmentfit/mesh.h"
#include "materials.h"
#include "sewn_pieces.h"
#include "single_precision_factor.h"
#include "soft_constraint.h"
#include "topology.h"

namespace garmentfit {

class ClothEnergy {
public:
    struct Spring {
        int i, j;
        double length, stiffness;  // m, N/m; the slack is not taken off
        double longest;  // m; beyond it the spring is stiffer

        /// Of i, N; of j it is the opposite. The load is what is left of the force without the quadratic form.
        Vec3 load(const Positions& x) const;
        Vec3 force(const Positions& x) const;
        /// Without the pressure of a compressed one, which would make the tangent indefinite [choi_2002_buckling].
        Eigen::Matrix3d tangent(const Positions& x) const;
    };
    /// A weighted sum of four vertices that wants to be what it is at rest, in a frame that turns along with them.
    struct FramedSum {
        enum class Kind { hinge, tie } kind;
        std::array<int, 4> v;  // the shared edge of a hinge, then the opposite corners; triangle and vertex of a tie
        std::array<double, 4> coefficients;  // for the mean curvature vector of a hinge, the offset of a tie
        Vec3 at_rest;  // that vector at rest, in the frame
        double stiffness;

        Eigen::Matrix3d frame(const Positions& x) const;
        Vec3 sum(const Positions& x) const;
        /// Of a vertex with the coefficient 1, N.
        Vec3 load(const Positions& x) const;
        Vec3 force(const Positions& x) const;
    };

    /// @param topology  of rest.triangles
    /// @param pairs     of vertices held at their rest distance, beside the edges
    /// @param sewn      of vertices held at their place over a triangle
    ClothEnergy(const GarmentMesh& rest, const MeshTopology& topology, const std::vector<std::pair<int, int>>& pairs,
                const Materials& materials, const std::vector<Tie>& sewn = {});
    /// The same of one material.
    ClothEnergy(const GarmentMesh& rest, const MeshTopology& topology, const std::vector<std::pair<int, int>>& pairs,
                const ClothOptions& options, const std::vector<Tie>& sewn = {});

    /// Seconds. Each new one costs one factorisation, of everything but the constraints.
    void set_time_step(double time_step);

    /// Of springs, hinges and ties, J; without strain limits.
    double elastic_energy(const Positions& x) const;
    /// Minus the gradient of that energy, N, with the frames of hinges and ties held.
    Positions elastic_forces(const Positions& x) const;
    const std::vector<double>& masses() const { return masses_; }  ///< kg
    const std::vector<double>& areas() const { return areas_; }  ///< m^2, of the cloth around each vertex at rest

    // ---- the parts of the implicit time step, for its solver ----

    double inertia() const { return inertia_; }  ///< 1 / h^2 of the time step h, 1/s^2
    /// The loads of springs, and of hinges and ties, when they are projected to their rest, N.
    Positions spring_loads(const Positions& x) const;
    Positions frame_loads(const Positions& x) const;
    /// The constant quadratic form (inertia, springs, hinges, ties) times x, N.
    Positions apply_quadratic_form(const Positions& x) const;
    const std::vector<Spring>& springs() const { return springs_; }
    const std::vector<FramedSum>& framed_sums() const { return sums_; }
    /// Approximately the inverse of that form times the residual, in single precision.
    Positions precondition(const Positions& residual) const { return factor_.solve(residual); }
    /// A constraint for each edge that is stretched beyond the limit.
    std::vector<SoftConstraint> strain_limits(const Positions& x) const;

private:
    using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;
    void add_springs(const GarmentMesh& rest, const MeshTopology& topology,
                     const std::vector<std::pair<int, int>>& pairs, const Materials& materials);
    void add_hinges(const GarmentMesh& rest, const MeshTopology& topology, const Materials& materials);
    void add_ties(const GarmentMesh& rest, const std::vector<Tie>& sewn, const Materials& materials);
    void assemble();
    Eigen::VectorXd lengthening(const Positions& x) const;  ///< of all springs, m
    /// What loads or forces of all springs do to the vertices, without the slack.
    Positions gather_springs(Vec3 (Spring::*of_spring)(const Positions&) const, const Positions& x) const;
    /// What loads or forces of all elements do to the vertices.
    template <class Element>
    static Positions gather(const SparseRows& gradients, const std::vector<Element>& elements,
                            Vec3 (Element::*of_element)(const Positions&) const, const Positions& x);
    static Positions multiply(const SparseRows& matrix, const Positions& x);

    std::vector<double> masses_, areas_;
    std::vector<Spring> springs_;
    std::vector<FramedSum> sums_;
    SparseRows slack_;  // springs x springs, N/m: what they pull with too much, by their lengthening; empty: nothing
    SparseRows spring_gradients_, sum_gradients_;  // n x elements: how their loads act on the vertices
    SparseRows elastic_;  // constant part of the system, n x n, both triangles
    SinglePrecisionFactor factor_;
    double inertia_ = 0;
};

}  // namespace garmentfit
