// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Quasi-Newton directions from the last few moves (L-BFGS, [nocedal_2006_optimization], algorithm 7.4).
//
// Units   Positions, moves and forces are n x 3. Forces are minus the gradient of what is minimised.

#include <vector>

#include "garmentfit/types.h"

namespace garmentfit {

class LimitedMemory {
public:
    explicit LimitedMemory(int moves) : most_(std::size_t(moves)) { }

    /// @param drop  of the forces along the move. A move along which they rise is not remembered: the curvature there is
    ///              negative, and the next direction would lead uphill
    void remember(Positions move, Positions drop)
    {
        const double curvature = move.cwiseProduct(drop).sum();
        if (!(curvature > k_least_cosine * move.norm() * drop.norm()))
            return;
        moves_.push_back({ std::move(move), std::move(drop), curvature });
        if (moves_.size() > most_)
            moves_.erase(moves_.begin());
    }

    void forget() { moves_.clear(); }
    bool empty() const { return moves_.empty(); }

    /// The direction in which these forces should vanish. Cost O(moves n) and one call.
    /// @param solve  Positions(const Positions& forces): the first guess, an inverse of a symmetric, definite matrix
    template <class Solve>
    Positions direction(const Positions& forces, const Solve& solve) const
    {
        Positions left = forces;
        std::vector<double> shares(moves_.size());
        for (std::size_t i = moves_.size(); i-- > 0;) {
            shares[i] = moves_[i].along.cwiseProduct(left).sum() / moves_[i].curvature;
            left -= shares[i] * moves_[i].drop;
        }
        Positions result = solve(left);
        for (std::size_t i = 0; i < moves_.size(); ++i)
            result += (shares[i] - moves_[i].drop.cwiseProduct(result).sum() / moves_[i].curvature) * moves_[i].along;
        return result;
    }

private:
    static constexpr double k_least_cosine = 1e-8;  // unit: rounding

    struct Move {
        Positions along, drop;
        double curvature;
    };
    std::size_t most_;
    std::vector<Move> moves_;
};

}  // namespace garmentfit
