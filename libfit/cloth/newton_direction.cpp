// SPDX-License-Identifier: GPL-3.0-or-later
#include "newton_direction.h"

#include <utility>

#include "tuning.h"

namespace garmentfit {
namespace {

double dot(const Positions& a, const Positions& b) { return a.cwiseProduct(b).sum(); }

}  // namespace

Positions newton_direction(const ClothEnergy& energy, const TangentFactor& factor, const Positions& x,
                           const std::vector<SoftConstraint>& constraints, const Positions& forces)
{
    Positions result = Positions::Zero(forces.rows(), 3), left = forces;
    Positions way = factor.solve(left);
    double square = dot(left, way);
    const double enough = k_newton_tolerance * k_newton_tolerance * square;
    bool is_enough = false;
    for (int i = 1; square > 0; ++i) {
        Positions resisting = energy.tangent_times(x, way);
        add_stiffness_times(constraints, way, resisting);
        const double length = square / dot(way, resisting);
        result += length * way;
        if (is_enough || i == k_newton_iterations)
            break;
        left -= length * resisting;
        const Positions next = factor.solve(left);
        const double before = std::exchange(square, dot(left, next));
        is_enough = square <= enough;  // the dear part of the next iteration, its solution, is done: go on with it
        way = next + square / before * way;
    }
    return result;
}

}  // namespace garmentfit
