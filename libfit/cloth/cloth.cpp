// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/cloth.h"

namespace garmentfit {
namespace {

struct Figures {
    std::string_view name;
    double density, stretch_stiffness, bend_stiffness, friction;
};

// In the order of Fabric. Bending from the middle of the ranges of Kawabata's bending test, 1 gf cm^2/cm being 9.8e-5 N m.
constexpr Figures k_fabrics[] = {
    { "cotton", 0.2, 400, 2e-5, 0.4 }, { "denim", 0.4, 800, 8e-5, 0.45 },  { "jersey", 0.17, 150, 4e-6, 0.4 },
    { "silk", 0.07, 300, 3e-6, 0.25 }, { "wool", 0.25, 400, 1.2e-5, 0.5 },
};

}  // namespace

const std::vector<std::string_view>& fabric_names()
{
    static const std::vector<std::string_view> names = [] {
        std::vector<std::string_view> result;
        for (const Figures& fabric : k_fabrics)
            result.push_back(fabric.name);
        return result;
    }();
    return names;
}

ClothOptions apply_fabric(ClothOptions options)
{
    const ClothOptions defaults;
    const Figures& fabric = k_fabrics[static_cast<int>(options.fabric)];
    const auto take = [&](double ClothOptions::*value, double figure) {
        if (options.*value == defaults.*value)
            options.*value = figure;
    };
    take(&ClothOptions::density, fabric.density);
    take(&ClothOptions::stretch_stiffness, fabric.stretch_stiffness);
    take(&ClothOptions::bend_stiffness, fabric.bend_stiffness);
    take(&ClothOptions::friction, fabric.friction);
    return options;
}

}  // namespace garmentfit
