// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "garmentfit/error.h"
#include "garmentfit/progress.h"

namespace garmentfit {

/// Runs what may fail, where there is something to fall back on. @return whether it did not fail @throws Cancelled
template <class Run>
bool succeeds(const Run& run)
try {
    run();
    return true;
} catch (const InvalidInput&) {
    return false;
} catch (const SolverFailure&) {
    return false;
} catch (const TimeLimitReached&) {
    return false;
}

}  // namespace garmentfit
