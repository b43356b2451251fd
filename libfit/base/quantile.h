// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace garmentfit {

/// The value that this fraction of them does not exceed; 0 for no values. O(n).
inline double quantile(std::vector<double> values, double fraction)
{
    if (values.empty())
        return 0;
    const auto nth = values.begin() + std::ptrdiff_t(fraction * double(values.size() - 1));
    std::nth_element(values.begin(), nth, values.end());
    return *nth;
}

}  // namespace garmentfit
