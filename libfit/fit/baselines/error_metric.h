// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What the published methods maximise by their relaxed search.

#include "posture.h"

namespace garmentfit {

/// How well a placed skeleton fits a garment. Thread-safe.
class ErrorMetric {
public:
    virtual ~ErrorMetric() = default;

    /// E, of the whole skeleton.
    virtual double total(const PlacedBones& bones) const = 0;
    /// E_B, by which directions of one bone compare.
    virtual double of_bone(int bone, const PlacedBones& bones) const = 0;
};

}  // namespace garmentfit
