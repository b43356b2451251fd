// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/cloth.h"

namespace garmentfit {
namespace {

struct NamedMaterial {
    std::string_view name;
    Material material;  // density, stretch_stiffness, bend_stiffness, friction
};

// In the order of Fabric.
// literature: bending [kawabata_1980_hand], the middle of the ranges of its bending test, 1 gf cm^2/cm being 9.8e-5 N
// m.
// fitted: the other columns are guesses, on the house data; docs/cloth.md says more.
constexpr NamedMaterial k_fabrics[] = {
    { "cotton", { 0.2, 400, 2e-5, 0.4 } },  { "denim", { 0.4, 800, 8e-5, 0.45 } },
    { "jersey", { 0.17, 150, 4e-6, 0.4 } }, { "silk", { 0.07, 300, 3e-6, 0.25 } },
    { "wool", { 0.25, 400, 1.2e-5, 0.5 } },
};

}  // namespace

const std::vector<std::string_view>& fabric_names()
{
    static const std::vector<std::string_view> names = [] {
        std::vector<std::string_view> result;
        for (const NamedMaterial& fabric : k_fabrics)
            result.push_back(fabric.name);
        return result;
    }();
    return names;
}

Material material_of(const ClothOptions& options)
{
    const Material& fabric = k_fabrics[static_cast<int>(options.fabric)].material;
    return { options.density.value_or(fabric.density), options.stretch_stiffness.value_or(fabric.stretch_stiffness),
             options.bend_stiffness.value_or(fabric.bend_stiffness), options.friction.value_or(fabric.friction) };
}

}  // namespace garmentfit
