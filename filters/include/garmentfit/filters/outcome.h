// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How fitting and dressing ended: a code and a sentence.

#include <string>
#include <vector>

#include "garmentfit/closed_ends.h"
#include "garmentfit/filters/filters.h"

namespace garmentfit {

/// The values are the command line's exit codes.
enum class Outcome { done = 0, too_small = 3, not_certified = 4 };

/// The last dressing of a scene; null where no garment was put on.
const Dressing* final_dressing(const Scene& scene);
/// All garments are draped over the full-sized body, and nothing crosses what moves on: them, or their stand-ins. Cloth
/// may still hold parts of the body back, such as fingers in a long sleeve: they may come free on the path to another pose.
bool all_put_on(const Scene& scene);
Outcome outcome_of(const Dressing& dressing);
/// Whether it is certified on skin that cloth presses in (RecoverOptions::press): the parts are in `held_back`.
bool is_pressed(const Dressing& dressing);
/// Whether it is not certified, though there was time, and cloth keeps parts of the body from their places.
bool is_held_back(const Dressing& dressing);
/// Whether the part that cloth keeps furthest from its place crosses another part of the body there: no cloth fits between
/// them, however it is put on.
bool is_held_where_body_crosses_itself(const Dressing& dressing);
/// Flat caps at the ends of a garment, which are taken for openings; 0 before it is fitted or put on.
int closed_ends(const Scene& scene, std::size_t garment);

/// Pieces of a garment that are no cloth and were left out; none before it is fitted or put on.
LeftOut left_out_of(const Scene& scene, std::size_t garment);
/// One line on what went wrong; only where the outcome is not `done`. `names` are those of the garments.
std::string explain(const Dressing& dressing, const std::vector<std::string>& names);
/// "coat.ply (coat): 0 crossings, minimum distance 0.9 mm, strain 4.1% at the 95th percentile". Where the garment
/// was given with crossings that did not come apart: "0 new crossings, 656 with itself kept as given, ...".
std::string in_one_line(const std::string& name, GarmentType type, const WornGarment& garment);
/// Certifies the garments as a host keeps them, which may be with fewer digits than they were computed with.
/// @param kept  positions of each garment of the dressing, metres; where it is worn, they become the dressing's
void certify_as_kept(Dressing& dressing, const Triangles& body, const std::vector<Positions>& kept);
/// Why no one pose serves the garments, one line for each two of them.
std::vector<std::string> explain(const std::vector<FitConflict>& conflicts, const std::vector<std::string>& names);
/// Rounded down: 100 means all of it.
int percent(double share);

}  // namespace garmentfit
