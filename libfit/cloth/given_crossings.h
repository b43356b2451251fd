// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Tells the crossings of a garment with itself from those that it was given with.

#include <vector>

#include "garmentfit/certificate.h"
#include "topology.h"

namespace garmentfit {

/// Crossings of a moved garment with itself, each in one of these, in ascending order.
struct ComparedCrossings {
    std::vector<Crossing> kept;  ///< pairs that it was given with
    std::vector<Crossing> shifted;  ///< pairs that lay on each other (Certificate::shifted_self_crossings)
    std::vector<Crossing> fresh;
};

/// m; of the two places that meet in a crossing, how that on the edge lay from that on the triangle at rest.
Vec3 offset_at_rest(const TriangleMesh& rest, const Edges& edges, const Positions& positions, const Crossing& crossing);

class GivenCrossings {
public:
    /// @param given     the garment at rest, its edges, and its crossings; ascending. The garment and its edges have to
    ///                  live as long.
    GivenCrossings(const TriangleMesh& given, const Edges& edges, const std::vector<Crossing>& crossings);

    /// @param present  the crossings of the garment where it is now; ascending
    ComparedCrossings compare(const Positions& positions, const std::vector<Crossing>& present) const;
    /// Those of the same crossings that are new however few there are: of cloth that lay apart.
    std::vector<Crossing> of_cloth_apart(const Positions& positions, std::vector<Crossing> present) const;

private:
    bool is_shifted(const Positions& positions, const Crossing& crossing) const;

    const TriangleMesh& given_;
    const Edges& edges_;
    std::size_t count_;  // of all that were given
    std::vector<Crossing> sure_;  // whatever the rounding
    std::vector<Crossing> touching_;  // within a border, where the curve of a sure one passes on to the next triangle
    double largest_gap_ = 0;  // m
};

}  // namespace garmentfit
