// SPDX-License-Identifier: GPL-3.0-or-later
#include "newton_step.h"

#include <algorithm>
#include <cmath>

#include "tangent_system.h"
#include "tuning.h"

namespace garmentfit {
namespace {

/// The balance of a time step: its forces, and the constraints that they come from.
class Balance {
public:
    Balance(const ClothEnergy& energy, const Positions& inertial, const ConstraintsAt& contacts) :
        energy_(energy), inertial_(inertial), contacts_(contacts)
    {
    }

    Positions forces(const Positions& x)
    {
        constraints_ = with_strain_limits(energy_, x, contacts_(x));
        Positions result = static_forces(energy_, x, constraints_);
        for (Eigen::Index v = 0; v < x.rows(); ++v)
            result.row(v) += energy_.masses()[v] * energy_.inertia() * (inertial_.row(v) - x.row(v));
        return result;
    }

    /// At the positions of the last call of forces().
    const std::vector<SoftConstraint>& constraints() const { return constraints_; }

private:
    const ClothEnergy& energy_;
    const Positions& inertial_;
    const ConstraintsAt& contacts_;
    std::vector<SoftConstraint> constraints_;
};

void limit_evenly(Positions& displacements, double longest)
{
    if (const double length = std::sqrt(displacements.rowwise().squaredNorm().maxCoeff()); length > longest)
        displacements *= longest / length;
}

// Contacts that open and close make the forces jump, so a whole step may go too far: then it is cut where the forces
// do less work against it. @return the forces at the new x
Positions search_along(const Positions& direction, const Positions& forces, Balance& balance, Positions& x)
{
    const Positions from = x;
    const double at_start = forces.cwiseProduct(direction).sum();
    double low = 0, high = 1, share = 1, at_low = at_start;
    for (int i = 0;; ++i) {
        x = from + share * direction;
        const Positions result = balance.forces(x);
        const double work = result.cwiseProduct(direction).sum();
        if (work > -k_overshoot * at_start && (share == 1 || work < k_overshoot * at_start))
            return result;
        if (i == k_most_shares)
            return result;
        if (work > 0) {
            low = share;
            at_low = work;
            share = 0.5 * (low + high);
        } else {
            high = share;
            share = low + (high - low) * std::clamp(at_low / (at_low - work), 0.1, 0.5);
        }
    }
}

}  // namespace

std::vector<SoftConstraint> with_strain_limits(const ClothEnergy& energy, const Positions& x,
                                               std::vector<SoftConstraint> contacts)
{
    const std::vector<SoftConstraint> limits = energy.strain_limits(x);
    contacts.insert(contacts.end(), limits.begin(), limits.end());
    return contacts;
}

Positions static_forces(const ClothEnergy& energy, const Positions& x, const std::vector<SoftConstraint>& constraints)
{
    Positions result = energy.elastic_forces(x);
    for (const SoftConstraint& constraint : constraints)
        add_force(constraint, constraint.stiffness_times(constraint.target - constraint.sum(x)), result);
    return result;
}

Positions newton_step(const ClothEnergy& energy, const Positions& start, const Positions& inertial, int iterations,
                      const ConstraintsAt& contacts)
{
    Balance balance(energy, inertial, contacts);
    Positions x = start, forces = balance.forces(x);
    for (int i = 0; i < iterations; ++i) {
        Positions direction = TangentSystem(energy, x, balance.constraints()).solve(forces, k_tangent_tolerance);
        limit_evenly(direction, k_largest_rest_move);
        forces = search_along(direction, forces, balance, x);
    }
    return x;
}

}  // namespace garmentfit
