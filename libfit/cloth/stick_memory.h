// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where contacts stick. Dry friction needs a memory: without one, every time step forgives the slip of the one before,
// and cloth creeps for ever under a force far inside the friction cone.
//
// Method  the tangential spring of [cundall_1979_granular], pair by pair: it is stretched by the slip since the pair
//         met, and slides when its force reaches the friction coefficient times the normal force.

#include <vector>

#include "contact.h"

namespace garmentfit {

class StickMemory {
public:
    /// The slip that a pair has stored, across `normal`, m; zero for a pair that did not touch.
    Vec3 stored(const ContactPair& pair, const Vec3& normal) const;

    /// What the pairs that touch have stored now; others are forgotten.
    struct Slip {
        PairKind kind;
        std::array<int, 4> vertices;
        Vec3 stored;  ///< m
    };
    void assign(std::vector<Slip> slips);
    void clear() { slips_.clear(); }

private:
    std::vector<Slip> slips_;  // sorted by pair
};

}  // namespace garmentfit
