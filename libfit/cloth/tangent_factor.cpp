// SPDX-License-Identifier: GPL-3.0-or-later
#include "tangent_factor.h"

#include <algorithm>
#include <cmath>

#include "garmentfit/error.h"

namespace garmentfit {
namespace {

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

Eigen::Matrix3d stiffness_matrix(const SoftConstraint& constraint)
{
    return constraint.tangent_stiffness * Eigen::Matrix3d::Identity()
        + (constraint.normal_stiffness - constraint.tangent_stiffness) * constraint.normal
        * constraint.normal.transpose();
}

}  // namespace

TangentFactor::TangentFactor(const ClothEnergy& energy) : energy_(energy)
{
    const int vertices = int(energy.masses().size());
    std::vector<Eigen::Triplet<double>> entries;
    const auto add_block = [&](int i, int j) {
        for (int c = 0; c < 3; ++c)
            for (int r = i == j ? c : 0; r < 3; ++r)
                entries.emplace_back(3 * i + r, 3 * j + c, 0.0);
    };
    for (int v = 0; v < vertices; ++v)
        add_block(v, v);
    for (const ClothEnergy::Spring& spring : energy.springs())
        add_block(std::max(spring.i, spring.j), std::min(spring.i, spring.j));
    matrix_.resize(3 * vertices, 3 * vertices);
    matrix_.setFromTriplets(entries.begin(), entries.end());
    factor_.analyzePattern(matrix_);
}

// The entries of a column from a row on, or nothing where the pattern has none there.
double* TangentFactor::find_column(int row, int column)
{
    const int* const begin = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[column];
    const int* const end = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[column + 1];
    const int* const found = std::lower_bound(begin, end, row);
    return found != end && *found == row ? matrix_.valuePtr() + (found - matrix_.innerIndexPtr()) : nullptr;
}

void TangentFactor::add(int i, int j, const Eigen::Matrix3d& block)
{
    for (int c = 0; c < 3; ++c) {
        const int first = i == j ? c : 0;
        double* const entries = find_column(3 * i + first, 3 * j + c);
        for (int r = first; r < 3; ++r)
            entries[r - first] += block(r, c);
    }
}

// Adds coefficients * coefficients^T, each entry times a block.
template <std::size_t Count>
void TangentFactor::add_outer(const std::array<int, Count>& vertices, const std::array<double, Count>& coefficients,
                              const Eigen::Matrix3d& block)
{
    for (std::size_t k = 0; k < Count; ++k) {
        if (vertices[k] < 0 || coefficients[k] == 0)
            continue;
        add(vertices[k], vertices[k], coefficients[k] * coefficients[k] * block);
        for (std::size_t l = 0; l < k; ++l) {
            if (vertices[l] < 0 || coefficients[l] == 0)
                continue;
            const double product = coefficients[k] * coefficients[l];
            const auto [low, high] = std::minmax(vertices[k], vertices[l]);
            if (find_column(3 * high, 3 * low)) {
                add(high, low, product * block);
            } else {
                add(low, low, std::abs(product) * block);
                add(high, high, std::abs(product) * block);
            }
        }
    }
}

void TangentFactor::factorise(const Positions& x, const std::vector<SoftConstraint>& constraints)
{
    const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
    std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.0);
    for (const ClothEnergy::Spring& spring : energy_.springs())
        add_outer<2>({ spring.i, spring.j }, { 1, -1 }, spring_tangent(spring, x));
    for (const ClothEnergy::FramedSum& sum : energy_.framed_sums())
        add_outer(sum.v, sum.coefficients, sum.stiffness * identity);
    for (const SoftConstraint& constraint : constraints)
        add_outer(constraint.vertices, constraint.weights, stiffness_matrix(constraint));
    for (int v = 0; v < int(x.rows()); ++v)
        add(v, v, energy_.masses()[v] * energy_.inertia() * identity);
    factor_.factorize(matrix_);
    if (factor_.info() != Eigen::Success)
        throw SolverFailure(
            "cloth: the tangent stiffness matrix of the garment could not be factorised. Remove faces without area "
            "from the garment, and look for figures of the fabric that are 0 or far too large.");
}

Positions TangentFactor::solve(const Positions& forces) const
{
    const Eigen::Map<const Eigen::VectorXd> right(forces.data(), forces.size());
    const Eigen::VectorXd solution = factor_.solve(right);
    return Eigen::Map<const Positions>(solution.data(), forces.rows(), 3);
}

}  // namespace garmentfit
