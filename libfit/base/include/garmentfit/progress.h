// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Progress, cancelling and time limits: one value goes down the call tree, and every step gets a slice of it.

#include <chrono>
#include <functional>
#include <string>
#include <string_view>

#include "garmentfit/export.h"

namespace garmentfit {

/// A point in time after which work ends early; never, by default.
class GARMENTFIT_API Deadline {
public:
    Deadline() = default;
    /// So many seconds from now; 0 for never.
    static Deadline in(double seconds);

    bool has_passed() const;
    bool operator<(const Deadline& other) const { return end_ < other.end_; }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point end_ = Clock::time_point::max();
};

class GARMENTFIT_API Progress {
public:
    /// Receives the fraction done in [0, 1] and the stage's name; false = please stop.
    using Report = std::function<bool(double fraction, std::string_view stage)>;

    Progress() = default;  ///< silent, never stops
    explicit Progress(Report report);

    /// The slice [from, to] of this progress. An empty stage keeps the name of this one.
    Progress part(double from, double to, std::string_view stage = {}) const;

    /// The same with a deadline; the earlier one where this has one already.
    Progress until(const Deadline& deadline) const;

    /// Reports a fraction of this slice. Call it from the thread that called libfit, at least once a second.
    /// @throws Cancelled when the receiver asks to stop, TimeLimitReached after the deadline.
    void at(double fraction) const;

    /// The same for work that can end here with a result. @return false after the deadline  @throws Cancelled.
    bool goes_on(double fraction) const;

    /// Whether the deadline has passed.
    bool is_late() const { return deadline_.has_passed(); }

private:
    Report report_;
    Deadline deadline_;
    double from_ = 0, to_ = 1;
    std::string stage_;
};

}  // namespace garmentfit
