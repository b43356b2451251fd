// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Progress and cancelling: one value goes down the call tree, and every step gets a slice of it.

#include <functional>
#include <string>
#include <string_view>

#include "garmentfit/export.h"

namespace garmentfit {

class GARMENTFIT_API Progress {
public:
    /// Receives the fraction done in [0, 1] and the stage's name; false = please stop.
    using Report = std::function<bool(double fraction, std::string_view stage)>;

    Progress() = default;  ///< silent, never stops
    explicit Progress(Report report);

    /// The slice [from, to] of this progress. An empty stage keeps the name of this one.
    Progress part(double from, double to, std::string_view stage = {}) const;

    /// Reports a fraction of this slice. Call it from the thread that called libfit, at least once a second.
    /// @throws Cancelled when the receiver asks to stop.
    void at(double fraction) const;

private:
    Report report_;
    double from_ = 0, to_ = 1;
    std::string stage_;
};

}  // namespace garmentfit
