// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where a body touches or enters itself, or nearly so, there is no room for cloth: armpits, crooks of elbows and knees, groins.
//
// While a body moves such creases are bridged from lip to lip, so that cloth slides over them and is not caught inside;
// at the end the skin retreats into the crease, away from the cloth, which nothing can hinder.

#include <vector>

#include "garmentfit/types.h"

namespace garmentfit {

class Creases {
public:
    /// Finds the creases of a surface as it stands (n x 3): vertices at which a ball, touching them from outside, has no room, or
    /// that lie inside another part. Cost O(n log n).
    /// @param near_cloth  of each vertex; creases without any such vertex (a mouth, say, or toes) are left alone
    Creases(const TriangleMesh& surface, const std::vector<char>& near_cloth);

    /// The surface (n x 3) with its creases bridged.
    const Positions& bridged() const { return bridged_; }

    /// The surface with what is in creases pulled halfway to `core`, where it collapses to: inside the body, where no cloth
    /// is. From a bridge into its crease the skin goes by way of this.
    Positions withdrawn(const Positions& core) const;

private:
    Positions surface_, bridged_;
    std::vector<int> inner_;  // vertices of the creases
};

/// Whether cloth (m x 3) is so near to each point of a body (n x 3, as it wears it) that it may get into creases there. O((n + m) log m).
std::vector<char> near_cloth(const Positions& body, const Positions& cloth);

}  // namespace garmentfit
