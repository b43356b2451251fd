// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace garmentfit {

/// m, between the two sheets of cloth with thickness: two sheets of half of the area enclose area * thickness / 2.
/// derived.
/// @param volume  m^3, signed or not, of a closed surface
/// @param area    m^2, of all of it
double thickness_of(double volume, double area);

/// Whether a closed surface is a panel of a pattern, with thickness: two sheets, much wider than they are apart. A
/// button is not.
bool is_panel(double thickness, double area);

/// m, from the border of a panel of this thickness to the one that it is sewn to: programs for patterns give panels
/// their thickness one by one, so the outer sheets of two that meet at an angle do not meet.
double panel_seam_distance(double thickness);

}  // namespace garmentfit
