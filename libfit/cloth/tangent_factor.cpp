// SPDX-License-Identifier: GPL-3.0-or-later
#include "tangent_factor.h"

#include <algorithm>
#include <cmath>

#include "garmentfit/error.h"

namespace garmentfit {
namespace {

// unit: N/m. Single precision leaves .06 N/m of it; springs have 10 to 4,000.
constexpr double k_stiffest_in_factor = 1e6;
// unit: a few times the rounding of single precision.
constexpr double k_least_shift = 1e-6;

// In single precision a barrier's stiffness without bound would drown that of the springs beside it.
Eigen::Matrix3d stiffness_matrix(const SoftConstraint& constraint)
{
    const double along = std::min(constraint.normal_stiffness, k_stiffest_in_factor);
    return constraint.tangent_stiffness * Eigen::Matrix3d::Identity()
        + (along - constraint.tangent_stiffness) * constraint.normal * constraint.normal.transpose();
}

/// Vertices of a spring, and what is sewn with the corners under it.
std::vector<std::pair<int, int>> coupled_pairs(const ClothEnergy& energy)
{
    std::vector<std::pair<int, int>> result;
    for (const ClothEnergy::Spring& spring : energy.springs())
        result.emplace_back(spring.i, spring.j);
    for (const ClothEnergy::FramedSum& sum : energy.framed_sums())
        if (sum.kind == ClothEnergy::FramedSum::Kind::tie)
            for (int k = 0; k < 3; ++k)
                if (sum.coefficients[k] != 0)
                    result.emplace_back(sum.v[k], sum.v[3]);
    return result;
}

}  // namespace

TangentFactor::TangentFactor(const ClothEnergy& energy) :
    energy_(energy), matrix_(int(energy.masses().size()), coupled_pairs(energy))
{
    for (const ClothEnergy::FramedSum& sum : energy_.framed_sums())
        add_outer(sum.v, sum.coefficients, sum.stiffness * Eigen::Matrix3d::Identity());
    framed_ = matrix_.blocks();
}

// Adds coefficients * coefficients^T, each entry times a block.
template <std::size_t Count>
void TangentFactor::add_outer(const std::array<int, Count>& vertices, const std::array<double, Count>& coefficients,
                              const Eigen::Matrix3d& block)
{
    for (std::size_t k = 0; k < Count; ++k) {
        if (vertices[k] < 0 || coefficients[k] == 0)
            continue;
        Eigen::Matrix3d& here = *matrix_.find(vertices[k], vertices[k]);
        here += coefficients[k] * coefficients[k] * block;
        for (std::size_t l = 0; l < k; ++l) {
            if (vertices[l] < 0 || coefficients[l] == 0)
                continue;
            const double product = coefficients[k] * coefficients[l];
            if (Eigen::Matrix3d* const both = matrix_.find(vertices[k], vertices[l])) {
                *both += product * block;
            } else {
                here += std::abs(product) * block;
                *matrix_.find(vertices[l], vertices[l]) += std::abs(product) * block;
            }
        }
    }
}

void TangentFactor::factorise(const Positions& x, const std::vector<SoftConstraint>& constraints)
{
    const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
    matrix_.set_blocks(framed_);
    for (const ClothEnergy::Spring& spring : energy_.springs())
        add_outer<2>({ spring.i, spring.j }, { 1, -1 }, spring.tangent(x));
    for (const SoftConstraint& constraint : constraints)
        add_outer(constraint.vertices, constraint.weights, stiffness_matrix(constraint));
    for (int v = 0; v < int(x.rows()); ++v)
        *matrix_.find(v, v) += energy_.masses()[v] * energy_.inertia() * identity;
    double shift = k_least_shift;  // rounding may leave a matrix that is nearly singular indefinite
    for (; !matrix_.factorise() && shift < 1; shift *= 10)
        for (int v = 0; v < int(x.rows()); ++v)
            *matrix_.find(v, v) += shift * matrix_.find(v, v)->trace() * identity;
    if (shift >= 1)
        throw SolverFailure(
            "cloth: the tangent stiffness matrix of the garment could not be factorised. Remove faces without area "
            "from the garment, and look for figures of the fabric that are 0 or far too large.");
}

Positions TangentFactor::solve(const Positions& forces) const { return matrix_.solve(forces); }

}  // namespace garmentfit
