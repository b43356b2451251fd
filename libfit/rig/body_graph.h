// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "curve_skeleton.h"

namespace garmentfit {

/// What the curve skeleton of a human says: which of its curves is which part of the body, sides still open.
struct BodyGraph {
    // Rows of CurveSkeleton::nodes, from the trunk outwards.
    std::array<std::vector<int>, 2> arms;  ///< from where they leave the trunk to the fingertips
    std::array<std::vector<int>, 2> legs;  ///< from the pelvis to the toes; legs[i] and arms[i] need not be of one side
    std::vector<int> head;  ///< from where the arms leave to the crown
    std::vector<int> trunk;  ///< from the pelvis to where the arms leave
    bool headless = false;  ///< the head's curve is only the node where the arms leave
    double size = 0;  ///< m, roughly the stature, from lengths along the curves
    double size_by_legs = 0;  ///< m, the same from the lengths between head and feet alone

    /// Where each node hangs: 0, 1 = arms, 2, 3 = legs, 4 = head, 5 = trunk, and the row of that curve. Fingers hang on
    /// the node that they branch off.
    struct Place {
        int curve = -1, row = 0;
    };
    std::vector<Place> place_of_node;

    const std::vector<int>& curve(int c) const { return c < 2 ? arms[c] : c < 4 ? legs[c - 2] : c == 4 ? head : trunk; }
};

/// Opens loops, prunes the graph to five ends (four where that leaves no head) and tells them apart by the lengths
/// between them, which no pose changes. O(n^2).
/// @throws InvalidInput where it does not have the five ends of a human, or not a human's proportions.
BodyGraph body_graph(const CurveSkeleton& skeleton);

}  // namespace garmentfit
