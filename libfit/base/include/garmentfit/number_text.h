// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Numbers as text, for messages and files. Independent of the locale's thousands and of stream state.

#include <string>

#include <Eigen/Core>

#include "garmentfit/export.h"

namespace garmentfit {

/// Shortest text that reads back as the same number.
GARMENTFIT_API std::string text_of(double value);
GARMENTFIT_API std::string text_of(float value);
/// The same for three numbers, with a blank between them.
GARMENTFIT_API std::string text_of(const Eigen::Vector3d& values);

/// With so many decimals: fixed_text(0.1234, 2) is "0.12".
GARMENTFIT_API std::string fixed_text(double value, int decimals);
/// With so many significant digits, without zeros at the end: rounded_text(1234.5, 3) is "1.23e+03".
GARMENTFIT_API std::string rounded_text(double value, int digits);
/// "(0.12, 1.50, -0.03) m", to the centimetre.
GARMENTFIT_API std::string place_text(const Eigen::Vector3d& metres);

}  // namespace garmentfit
