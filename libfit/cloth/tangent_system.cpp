// SPDX-License-Identifier: GPL-3.0-or-later
#include "tangent_system.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "garmentfit/error.h"
#include "tuning.h"

namespace garmentfit {
namespace {

/// The lower triangle of a sparse matrix of 3 x 3 blocks.
class BlockMatrix {
public:
    explicit BlockMatrix(Eigen::Index rows) : rows_(rows) { }

    void add(int i, int j, const Eigen::Matrix3d& block)
    {
        for (int c = 0; c < 3; ++c)
            for (int r = i == j ? c : 0; i >= j && r < 3; ++r)
                entries_.emplace_back(3 * i + r, 3 * j + c, block(r, c));
    }

    /// coefficients * coefficients^T, each entry times a block.
    template <std::size_t Count>
    void add_outer(const std::array<int, Count>& vertices, const std::array<double, Count>& coefficients,
                   const Eigen::Matrix3d& block)
    {
        for (std::size_t k = 0; k < Count; ++k)
            for (std::size_t l = 0; l < Count; ++l)
                if (vertices[k] >= 0 && vertices[l] >= 0 && coefficients[k] * coefficients[l] != 0)
                    add(vertices[k], vertices[l], coefficients[k] * coefficients[l] * block);
    }

    Eigen::SparseMatrix<double> assemble() const
    {
        Eigen::SparseMatrix<double> result(3 * rows_, 3 * rows_);
        result.setFromTriplets(entries_.begin(), entries_.end());
        return result;
    }

private:
    Eigen::Index rows_;
    std::vector<Eigen::Triplet<double>> entries_;
};

Eigen::Matrix3d spring_tangent(const ClothEnergy::Spring& spring, const Positions& x)
{
    const Vec3 edge = (x.row(spring.i) - x.row(spring.j)).transpose();
    const double length = edge.norm();
    if (!(length > 0))
        return Eigen::Matrix3d::Zero();
    const Eigen::Matrix3d along = edge * edge.transpose() / (length * length);
    const double across = std::max(0.0, 1 - spring.length / length);
    return spring.stiffness * (along + across * (Eigen::Matrix3d::Identity() - along));
}

// Both corners opposite to the edge of a hinge have no edge in common. What couples them is moved to the diagonal,
// which makes the form larger: it stays definite.
void add_hinge(BlockMatrix& matrix, const ClothEnergy::FramedSum& hinge)
{
    const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
    const auto& [a, b, c, d] = hinge.v;
    const auto& w = hinge.coefficients;
    matrix.add_outer<3>({ a, b, c }, { w[0], w[1], w[2] }, hinge.stiffness * identity);
    for (const auto& [vertex, weight] : { std::pair(a, w[0]), std::pair(b, w[1]) }) {
        matrix.add(vertex, d, hinge.stiffness * weight * w[3] * identity);
        matrix.add(d, vertex, hinge.stiffness * weight * w[3] * identity);
    }
    matrix.add(d, d, hinge.stiffness * w[3] * w[3] * identity);
    for (const int v : { c, d })
        matrix.add(v, v, hinge.stiffness * std::abs(w[2] * w[3]) * identity);
}

Eigen::Matrix3d stiffness_matrix(const SoftConstraint& constraint)
{
    return constraint.tangent_stiffness * Eigen::Matrix3d::Identity()
        + (constraint.normal_stiffness - constraint.tangent_stiffness) * constraint.normal
        * constraint.normal.transpose();
}

}  // namespace

TangentSystem::TangentSystem(const ClothEnergy& energy, const Positions& x,
                             const std::vector<SoftConstraint>& constraints) :
    energy_(energy),
    constraints_(constraints)
{
    BlockMatrix matrix(x.rows());
    for (const ClothEnergy::Spring& spring : energy.springs()) {
        spring_tangents_.push_back(spring_tangent(spring, x));
        matrix.add_outer<2>({ spring.i, spring.j }, { 1, -1 }, spring_tangents_.back());
    }
    for (const ClothEnergy::FramedSum& sum : energy.framed_sums())
        if (sum.kind == ClothEnergy::FramedSum::Kind::hinge)
            add_hinge(matrix, sum);
        else
            matrix.add_outer(sum.v, sum.coefficients, sum.stiffness * Eigen::Matrix3d::Identity());
    for (const SoftConstraint& constraint : constraints)
        matrix.add_outer(constraint.vertices, constraint.weights, stiffness_matrix(constraint));
    for (int v = 0; v < int(x.rows()); ++v)
        matrix.add(v, v, energy.masses()[v] * energy.inertia() * Eigen::Matrix3d::Identity());
    factor_.compute(matrix.assemble());
    if (factor_.info() != Eigen::Success)
        throw SolverFailure(
            "cloth: the tangent stiffness matrix of the garment could not be factorised. Remove faces without area "
            "from the garment, and look for figures of the fabric that are 0 or far too large.");
}

Positions TangentSystem::multiply(const Positions& displacement) const
{
    Positions result = energy_.apply_framed_form(displacement);
    for (std::size_t e = 0; e < spring_tangents_.size(); ++e) {
        const ClothEnergy::Spring& s = energy_.springs()[e];
        const Vec3 force = spring_tangents_[e] * (displacement.row(s.i) - displacement.row(s.j)).transpose();
        result.row(s.i) += force.transpose();
        result.row(s.j) -= force.transpose();
    }
    for (const SoftConstraint& constraint : constraints_)
        add_force(constraint, constraint.stiffness_times(constraint.sum(displacement)), result);
    return result;
}

Positions TangentSystem::precondition(const Positions& forces) const
{
    const Eigen::Map<const Eigen::VectorXd> right(forces.data(), forces.size());
    const Eigen::VectorXd solution = factor_.solve(right);
    return Eigen::Map<const Positions>(solution.data(), forces.rows(), 3);
}

Positions TangentSystem::solve(const Positions& forces, double tolerance) const
{
    Positions x = Positions::Zero(forces.rows(), 3), residual = forces, steepest = precondition(residual),
              direction = steepest;
    double square = residual.cwiseProduct(steepest).sum();
    for (int i = 0; i < k_most_tangent_iterations && residual.norm() > tolerance * forces.norm(); ++i) {
        const Positions along = multiply(direction);
        const double length = square / direction.cwiseProduct(along).sum();
        x += length * direction;
        residual -= length * along;
        steepest = precondition(residual);
        const double before = std::exchange(square, residual.cwiseProduct(steepest).sum());
        direction = steepest + square / before * direction;
    }
    return x;
}

}  // namespace garmentfit
