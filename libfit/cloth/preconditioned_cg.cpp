// SPDX-License-Identifier: GPL-3.0-or-later
#include "preconditioned_cg.h"

#include <algorithm>

namespace garmentfit {

PreconditionedCG::PreconditionedCG(const ClothEnergy& energy, const Positions& start, const Positions& inertial) :
    energy_(energy), inertial_(inertial), x_(start), applied_(energy.apply_quadratic_form(start))
{
}

void PreconditionedCG::set_constraints(const std::vector<SoftConstraint>& constraints)
{
    constraints_ = constraints;
    const std::vector<SoftConstraint> limits = energy_.strain_limits(x_);
    constraints_.insert(constraints_.end(), limits.begin(), limits.end());
    constant_ = energy_.frame_loads(x_);
    for (Eigen::Index v = 0; v < x_.rows(); ++v)
        constant_.row(v) += energy_.masses()[v] * energy_.inertia() * inertial_.row(v);
    for (const SoftConstraint& constraint : constraints_)
        add_force(constraint, constraint.stiffness_times(constraint.target), constant_);
}

// Polak and Ribiere: where the residual does not change smoothly, their factor falls below 0 and the direction is the
// steepest one again.
void PreconditionedCG::update_direction(const Positions& residual)
{
    const Positions steepest = energy_.precondition(residual);
    const double square = residual.cwiseProduct(steepest).sum();
    const double kept = square_ > 0 ? std::max(0.0, (square - residual_.cwiseProduct(steepest).sum()) / square_) : 0.0;
    direction_ = kept > 0 ? Positions(steepest + kept * direction_) : steepest;
    if (residual.cwiseProduct(direction_).sum() <= 0)
        direction_ = steepest;
    square_ = square;
}

void PreconditionedCG::iterate()
{
    if (constant_.rows() == 0)
        set_constraints({});
    Positions constrained = Positions::Zero(x_.rows(), 3);
    add_stiffness_times(constraints_, x_, constrained);  // their targets are in constant_
    const Positions residual = constant_ + energy_.spring_loads(x_) - applied_ - constrained;
    update_direction(residual);
    const Positions along = energy_.apply_quadratic_form(direction_);
    constrained = along;
    add_stiffness_times(constraints_, direction_, constrained);
    if (const double curvature = direction_.cwiseProduct(constrained).sum(); curvature > 0) {
        const double length = residual.cwiseProduct(direction_).sum() / curvature;
        x_ += length * direction_;
        applied_ += length * along;
    }
    residual_ = residual;
}

}  // namespace garmentfit
