// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Details of clothes (sewn_pieces.h) as stiff pieces, while cloth looks for its rest.
//
// Edges of a button are of a millimetre, and its vertices weigh next to nothing: forces that bend it hardly ever balance.
// So a detail keeps the shape that it has, and goes by the stiff motion nearest to that of the vertices that it is sewn
// to [umeyama_1991_similarity], its ground. All forces on it act on the ground, as one force and one torque about its
// middle, spread so that they do the same work there; forces within the detail add up to nothing. Where a detail is a
// link between two parts of the cloth, its ground is as stiff as itself: it goes by its own nearest stiff motion.
//
// Units   metres, newtons. Positions and forces are n x 3.

#include <vector>

#include "sewn_pieces.h"

namespace garmentfit {

class StiffDetails {
public:
    /// Details on less than three vertices, or on vertices in a line, are cloth as any other.
    /// @param x  where the cloth is
    StiffDetails(const SewnPieces& sewn, const Positions& x);

    bool empty() const { return details_.empty(); }
    bool contains(int vertex) const { return is_detail_[vertex]; }
    /// Those that hold no detail.
    std::vector<Tie> other_ties(const std::vector<Tie>& ties) const;

    /// Moves each detail to where its ground has gone.
    void follow(Positions& x) const;
    /// Ways from x, with those of details as their ground goes.
    Positions following(Positions ways, const Positions& x) const;
    /// Moves the forces on each detail to its ground.
    void hand_down(Positions& forces, const Positions& x) const;

private:
    struct Detail {
        std::vector<int> vertices, ground;  // of a link, the ground is among the vertices
        Positions shape, ground_shape;  // where these were at the start
    };
    std::vector<Detail> details_;
    std::vector<char> is_detail_;  // by vertex
};

}  // namespace garmentfit
