// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/progress.h"

#include <algorithm>

#include "garmentfit/error.h"

namespace garmentfit {

Deadline Deadline::in(double seconds)
{
    Deadline deadline;
    if (seconds > 0)
        deadline.end_
            = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    return deadline;
}

bool Deadline::has_passed() const { return end_ != Clock::time_point::max() && Clock::now() >= end_; }

Progress::Progress(Report report) : report_(std::move(report)) { }

Progress Progress::part(double from, double to, std::string_view stage) const
{
    Progress slice = *this;
    slice.from_ = from_ + from * (to_ - from_);
    slice.to_ = from_ + to * (to_ - from_);
    if (!stage.empty())
        slice.stage_ = stage;
    return slice;
}

Progress Progress::until(const Deadline& deadline) const
{
    Progress limited = *this;
    limited.deadline_ = std::min(deadline_, deadline);
    return limited;
}

void Progress::at(double fraction) const
{
    if (!goes_on(fraction))
        throw TimeLimitReached();
}

bool Progress::goes_on(double fraction) const
{
    if (report_ && !report_(from_ + std::clamp(fraction, 0.0, 1.0) * (to_ - from_), stage_))
        throw Cancelled();
    return !is_late();
}

}  // namespace garmentfit
