// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "tuning.h"

namespace garmentfit {

/// Tells when it is no longer worth waiting for parts of the obstacle that cloth holds back.
class StallDetector {
public:
    explicit StallDetector(int most_steps) : most_steps_(most_steps) { }

    /// Whether one more step is worth its time: something lags (metres), and that has become less lately.
    bool goes_on(double lag)
    {
        if (lag < k_progress * least_lag_) {
            least_lag_ = lag;
            steps_since_ = 0;
        }
        return lag > 0 && ++steps_since_ <= k_stall_steps && ++steps_ <= most_steps_;
    }

private:
    double least_lag_ = INFINITY;
    int most_steps_, steps_ = 0, steps_since_ = 0;
};

}  // namespace garmentfit
