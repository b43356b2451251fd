// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Log lines, warnings and numbers that a filter returns.

#include <map>
#include <string>
#include <vector>

#include "fitting.h"
#include "garmentfit/fit_map.h"

namespace garmentfit::meshlab {

struct Report {
    std::vector<std::string> lines, warnings;
    std::map<std::string, double> numbers;  ///< for scripts; lengths in the body's unit

    void warn(const std::vector<std::string>& more);
};

/// Reports the results of fitting and dressing.
void report_scene(Report& report, const Fitting& fitting);

void report_girths(Report& report, const std::vector<Girth>& girths, double metres_per_unit);

}  // namespace garmentfit::meshlab
