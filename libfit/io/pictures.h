// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Pictures of materials, which are passed on as they are.

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "garmentfit/appearance.h"

namespace garmentfit {

/// "image/png" or "image/jpeg" by the first bytes; empty: neither.
std::string picture_type(std::string_view bytes);

/// Width and height in pixels of a PNG or JPEG; zeros where its header does not say.
std::pair<int, int> picture_size(std::string_view bytes);

/// Empty where any program can show as many pixels.
std::string warning_of_size(const std::string& name, std::string_view bytes);

/// Adds a picture; of a type that glTF does not know with a warning only. @return its row, -1 where it cannot be kept
int add_picture(Appearance& look, const std::string& name, std::string bytes);

}  // namespace garmentfit
