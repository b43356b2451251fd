// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The elastic energy of a garment and its implicit time step.
//
// Method   the energies of projective dynamics [bouaziz_2014_projective_dynamics], minimised by nonlinear conjugate gradients
//          (Polak and Ribiere) with the constant quadratic form of their global step as preconditioner; compare
//          [liu_2017_quasi_newton].
// Stretch  a spring along each edge that wants its rest length; much overstretched ones are stiffer (Provot 1995 stops them at once).
// Bend     quadratic hinges, Bergou et al. 2006, that want the mean curvature vector they have at rest, turned along with the
//          hinge: the garment's own folds stay.
// Units    metres, kilograms, seconds.

#include <Eigen/SparseCore>
#include <array>
#include <vector>

#include "garmentfit/cloth.h"
#include "garmentfit/mesh.h"
#include "single_precision_factor.h"

namespace garmentfit {

/// A wish of contact for a weighted sum s of up to four vertices: be at `target`, energy 1/2 (s - target)^T K (s - target)
/// with the stiffness K = normal_stiffness along the normal and tangent_stiffness across it, N/m.
struct Press {
    std::array<int, 4> vertices;  ///< -1: not cloth, takes no part
    std::array<double, 4> weights;
    Vec3 target, normal;
    double normal_stiffness, tangent_stiffness;

    Vec3 stiffness_times(const Vec3& s) const
    {
        return tangent_stiffness * s + (normal_stiffness - tangent_stiffness) * normal.dot(s) * normal;
    }
};

class ClothEnergy {
public:
    /// @param ties  pairs of vertices held at their rest distance, beside the edges
    ClothEnergy(const GarmentMesh& rest, const std::vector<std::pair<int, int>>& ties, const ClothOptions& options);

    /// Seconds. One factorisation for each new one, of all but contact.
    void set_time_step(double time_step);

    /// Of springs and hinges, J; without what locks.
    double elastic_energy(const Positions& x) const;
    /// What they pull the vertices with, N, n x 3: minus the gradient of that energy, the hinges' frames held.
    Positions elastic_forces(const Positions& x) const;
    const std::vector<double>& masses() const { return masses_; }  ///< kg

private:
    friend class Descent;
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
    static Positions product(const SparseRows& matrix, const Positions& x);
    Positions spring_pulls(const Positions& x) const;
    Positions hinge_pulls(const Positions& x) const;
    std::vector<Press> locks(const Positions& x) const;
    Positions applied(const Positions& x) const;
    void add_hinges(const GarmentMesh& rest, double bend_stiffness);

    std::vector<double> masses_;
    std::vector<Spring> springs_;
    std::vector<Hinge> hinges_;
    SparseRows pulled_by_springs_, pulled_by_hinges_;  // n x elements: how they pull at the vertices
    SparseRows elastic_;  // constant part of the system, n x n, both triangles
    SinglePrecisionFactor factor_;
    double inertia_ = 0;  // 1 / h^2
};

/// A walk from positions (n x 3) down to the minimum of inertia (about `inertial`, n x 3), stretch, bend and presses.
class Descent {
public:
    Descent(const ClothEnergy& energy, const Positions& start, const Positions& inertial);

    /// What presses from now on, and how the hinges lie; both hold still until the next call. Without a call, nothing presses.
    void press(const std::vector<Press>& presses);
    /// One step. Never up, but for what hinges turn.
    void step();

    const Positions& positions() const { return x_; }

private:
    void turn_direction(const Positions& residual);
    void add_pressed(const Positions& x, Positions& sum) const;

    const ClothEnergy& energy_;
    const Positions& inertial_;
    std::vector<Press> presses_;
    Positions x_;
    Positions constant_;  // loads that stay until the next press(): of inertia, hinges and presses
    Positions applied_;  // the constant quadratic form applied to x_, without presses
    Positions residual_, direction_;  // of the last step
    double square_ = 0;  // of that residual, in the preconditioner's measure
};

}  // namespace garmentfit
