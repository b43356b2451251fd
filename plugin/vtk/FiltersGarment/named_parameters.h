// SPDX-License-Identifier: GPL-3.0-or-later

// A filter's parameters by their names in the schema, as numbers and as text. Unknown names and null are allowed.

#ifndef named_parameters_h
#define named_parameters_h

#include <string>
#include <utility>
#include <vector>

#include "garmentfit/filters/filters.h"

namespace garmentfit {

std::vector<std::string> parameter_names(const Filter& filter);
bool has_parameter(const Filter& filter, const char* name);

/// Choices are numbered from 0, switches are 0 or 1; NaN is an optional value that is not given. 0 where there is no
/// such parameter.
double number_of(const Filter& filter, const Parameters& parameters, const char* name);
/// Smallest and largest allowed value.
std::pair<double, double> range_of_number(const Filter& filter, const char* name);
/// Moves the number into its range. @return whether the parameter changed
bool set_number(const Filter& filter, Parameters& parameters, const char* name, double number);

std::string text_of(const Filter& filter, const Parameters& parameters, const char* name);
/// @return whether the parameter changed  @throws InvalidInput for a text that is no value
bool set_text(const Filter& filter, Parameters& parameters, const char* name, const char* text);

/// Help, range and unit in one line.
std::string help_on(const Filter& filter, const char* name);

}  // namespace garmentfit

#endif
