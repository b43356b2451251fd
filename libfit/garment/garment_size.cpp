// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/garment_size.h"

#include "outward_cloth.h"
#include "tuning.h"
#include "type_guess.h"

namespace garmentfit {

std::vector<double> wearer_heights(const GarmentMesh& garment)
{
    return wearer_heights(measures_of(openings_of(outward_cloth(garment))));
}

std::vector<double> wearer_heights(const GarmentMeasures& measures)
{
    using namespace garment_tuning;
    std::vector<double> heights;
    const auto add = [&](double measure, double usual) {
        if (measure > 0)
            heights.push_back(k_usual_wearer * measure / usual);
    };
    add(measures.shoulders, k_usual_shoulders);
    add(measures.sleeve, k_usual_sleeve);
    add(measures.trunk, k_usual_trunk);
    add(measures.leg, k_usual_leg);
    return heights;
}

}  // namespace garmentfit
