// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "curve_skeleton.h"
#include "curve_tree.h"

namespace garmentfit {

// derived: the places after arms and legs in curve()
constexpr int k_head_curve = 4, k_trunk_curve = 5;

/// Body part of each curve of a human's curve skeleton. Left and right are not known yet.
struct BodyGraph {
    // Rows of CurveSkeleton::nodes, from the trunk outwards.
    std::array<std::vector<int>, 2> arms;  ///< from where they leave the trunk to the fingertips
    std::array<std::vector<int>, 2> legs;  ///< from the pelvis to the toes; legs[i] and arms[i] need not be of one side
    std::vector<int> head;  ///< from where the arms leave to the crown
    std::vector<int> trunk;  ///< from the pelvis to where the arms leave
    bool headless = false;  ///< the head's curve is only the node where the arms leave
    bool has_covered_legs = false;  ///< the trunk's curve goes down to a hem, and the legs' begin there
    double size = 0;  ///< m, roughly the stature, from lengths along the curves
    double spread = 0;  ///< of the logarithms of the lengths between the ends from a human's: their standard deviation
    double size_by_legs = 0;  ///< m, the same from the lengths between head and feet alone

    /// Curve of each node (0, 1 = arms, 2, 3 = legs, 4 = head, 5 = trunk) and row of that curve. Fingers belong to the
    /// node from which they branch off.
    struct Place {
        int curve = -1, row = 0;
    };
    std::vector<Place> place_of_node;

    const std::vector<int>& curve(int c) const
    {
        return c < 2 ? arms[c] : c < k_head_curve ? legs[c - 2] : c == k_head_curve ? head : trunk;
    }
};

/// Leaves of a tree by name, as nodes; head is -1 where there is none.
struct Ends {
    int head, hand0, hand1, foot0, foot1;
};

/// The curves between the ends, without sizes. @throws InvalidInput when the arms do not leave the spine.
BodyGraph graph_of(const CurveTree& tree, const Ends& ends, const CurveSkeleton& skeleton);

/// Opens loops, prunes the graph to five ends (four if no head is found) and names them by the lengths between them,
/// which do not depend on the pose. O(n^2).
/// @throws InvalidInput when the graph does not have five ends, or when the lengths are not those of a human.
BodyGraph body_graph(const CurveSkeleton& skeleton);

}  // namespace garmentfit
