// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/cloth.h"

#include <algorithm>
#include <string>

#include "garmentfit/error.h"
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

Fabric fabric_of(std::string_view name)
{
    std::string known;
    for (std::size_t i = 0; i < fabric_names().size(); ++i) {
        if (fabric_names()[i] == name)
            return Fabric(i);
        known += (known.empty() ? "" : ", ") + std::string(fabric_names()[i]);
    }
    throw InvalidInput(ErrorCode::unknown_name,
                       "no fabric is called \"" + std::string(name) + "\"; give one of " + known);
}

Material material_of(Fabric fabric) { return k_fabrics[static_cast<int>(fabric)].material; }

Material material_of(const ClothOptions& options, Fabric fabric)
{
    const Material table = material_of(fabric);
    return { options.density.value_or(table.density),
             options.stretch_stiffness.value_or(table.stretch_stiffness),
             options.bend_stiffness.value_or(table.bend_stiffness),
             options.friction.value_or(table.friction),
             options.largest_stretch.value_or(table.largest_stretch),
             table.strain_limit,
             table.thickness,
             options.weft_to_warp.value_or(table.weft_to_warp),
             options.shear_stiffness.value_or(table.shear_stiffness) };
}

Material material_of(const ClothOptions& options) { return material_of(options, options.fabric); }

std::optional<Fabric> fabric_that_gives(double stretch, double present)
{
    std::optional<Fabric> best;
    for (std::size_t i = 0; i < fabric_names().size(); ++i) {
        const double given = material_of(Fabric(i)).largest_stretch;
        if (given >= stretch && given > present && (!best || given < material_of(*best).largest_stretch))
            best = Fabric(i);
    }
    return best;
}

}  // namespace garmentfit
