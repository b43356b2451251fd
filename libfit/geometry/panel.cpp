// SPDX-License-Identifier: GPL-3.0-or-later
#include "panel.h"

#include <cmath>

#include "tuning.h"

namespace garmentfit {

double thickness_of(double volume, double area) { return 2 * std::abs(volume) / area; }

bool is_panel(double thickness, double area)
{
    return thickness <= k_thickest_panel && thickness < k_panel_thickness * std::sqrt(area);
}

double panel_seam_distance(double thickness) { return k_panel_seam * thickness; }

}  // namespace garmentfit
