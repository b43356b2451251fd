// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What a filter tells its user.

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "garmentfit/fit_map.h"
#include "fitting.h"

namespace garmentfit::meshlab {

struct Report {
    std::vector<std::string> lines, warnings;
    std::map<std::string, double> numbers;  ///< for scripts; lengths in the body's unit

    void warn(const std::vector<std::string>& warnings);
};

/// "set swap_sides", for warnings.
std::string set_field(std::string_view parameter);

/// How fitting or dressing ended.
void report_scene(Report& report, const Fitting& fitting);

void report_girths(Report& report, const std::vector<Girth>& girths, double metres_per_unit);

}  // namespace garmentfit::meshlab
