// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string_view>

namespace garmentfit {

struct KnownUnit {
    std::string_view name;
    double metres;
    double log_rarity;   ///< how much rarer than metres it is in mesh files, as a logarithm; experience, not a count
};

constexpr std::array<KnownUnit, 6> k_known_units { { { "m", 1, 0 }, { "dm", 0.1, 0.5 }, { "cm", 0.01, 0.2 },
                                                     { "mm", 0.001, 0.2 }, { "in", 0.0254, 2.2 }, { "ft", 0.3048, 3 } } };

}  // namespace garmentfit
