// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/cloth.h"

#include "tuning.h"

namespace garmentfit {

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
