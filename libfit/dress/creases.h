// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Bridges the creases of a body: armpits, crooks of elbows and knees, groins, where it touches or enters itself, or
// nearly so. Cloth has no clearance there, and cannot get out again.
//
// While a body moves, each crease is bridged between the two sides of its boundary, so that cloth slides over it. At
// the end the skin goes back into the crease from within, where no cloth hinders it
// (docs/decisions/0012-taut-bridges.md).

#include <vector>

#include "garmentfit/types.h"

namespace garmentfit {

/// Where the bridge over a crease ends that is open on several sides, as between thighs or between an arm and the chest.
enum class BridgeEnds {
    bottom,  ///< at the lower end of the contact: no cloth stays between the two sides
    nearest,  ///< at the nearest side of each vertex: where bottom asks more of the cloth than it gives
};

class Creases {
public:
    /// Finds the creases of a surface as it stands (n x 3): vertices at which a ball that touches them from outside has
    /// no clearance, or that lie inside another part. Cost O(n log n).
    /// @param near_cloth  of each vertex; creases without any such vertex (a mouth, say, or toes) are left alone
    Creases(const TriangleMesh& surface, const std::vector<char>& near_cloth, BridgeEnds ends = BridgeEnds::bottom);

    /// The surface (n x 3) with its creases bridged.
    const Positions& bridged_surface() const { return bridged_; }

    /// The surface with the skin in creases drawn part of the way to `core`, where it collapses to: into the body,
    /// where no cloth is. The skin goes from a bridge to its place through this surface.
    Positions withdrawn_surface(const Positions& core) const;

private:
    Positions surface_, bridged_;
    std::vector<int> inner_;  // vertices of the creases
};

/// Whether cloth (m x 3) is so near to each point of a body (n x 3, as it wears it) that it may get into creases there.
/// O((n + m) log m).
std::vector<char> mark_near_cloth(const Positions& body, const Positions& cloth);

}  // namespace garmentfit
