// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "body_graph.h"
#include "garmentfit/types.h"

namespace garmentfit {

/// A body of any proportions that has two arms, two legs and a trunk.
struct Figure {
    BodyGraph graph;  ///< its sizes are of the whole; those of the limbs stand below
    double arm_size = 0, leg_size = 0;  ///< m, the stature of a human with limbs of this length
    double cost = 0;  ///< of the names: half the sum of squared deviations, in standard deviations
};

/// Legs that a gown hides down to the ground are taken for a human's length, where arms and head are a human's to that.
/// Opens loops, and of all choices of head, hands and feet among the longest ends takes the most likely one: limbs of a
/// pair are as long and as thick as each other and leave the trunk at one height, no long end is left over, proportions
/// differ from a human's by factors, and the trunk rather stands. A head may be missing. O(ways * n^5), n <= 9 ends.
/// @throws InvalidInput when there are fewer than four ends, or when no choice is likely.
Figure figure_graph(const CurveSkeleton& skeleton, const TriangleMesh& proxy);

}  // namespace garmentfit
