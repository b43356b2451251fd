// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/progress.h"

#include <algorithm>

#include "garmentfit/error.h"

namespace garmentfit {

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

void Progress::at(double fraction) const
{
    if (report_ && !report_(from_ + std::clamp(fraction, 0.0, 1.0) * (to_ - from_), stage_))
        throw Cancelled();
}

}  // namespace garmentfit
