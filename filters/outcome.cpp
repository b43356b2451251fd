// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/filters/outcome.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <utility>

#include "garmentfit/filters/verdict.h"
#include "garmentfit/number_text.h"
#include "garmentfit/units.h"
#include "tuning.h"

namespace garmentfit {
namespace {

constexpr std::size_t k_named = 3;  // unit: parts of the body that one line of text names

/// Those of the garment that has the tightest part.
std::vector<TooTight> tight_parts(const Dressing& dressing)
{
    std::vector<TooTight> parts;
    for (const TooTight& part : dressing.too_tight)
        if (part.garment == dressing.too_tight.front().garment)
            parts.push_back(part);
    return parts;
}

std::string held_parts(const Dressing& dressing)
{
    std::ostringstream text;
    for (std::size_t i = 0; i < std::min(k_named, dressing.held_back.size()); ++i)
        text << (i > 0 ? ", " : "; too little space for the cloth at ") << dressing.held_back[i].part
             << " (held back by " << length_text(dressing.held_back[i].distance, dressing.unit) << ")";
    return text.str();
}

std::string entered_parts(const Dressing& dressing)
{
    std::ostringstream text;
    for (std::size_t i = 0; i < std::min(k_named, dressing.overlaps.size()); ++i) {
        const Overlap& overlap = dressing.overlaps[i];
        text << (i > 0 ? ", " : "; the body crosses itself, and no cloth fits between ") << overlap.part << " and "
             << overlap.other << " (" << length_text(overlap.depth, dressing.unit) << " deep)";
    }
    return text.str();
}

/// How much press, m, lets the skin give way where it is held back; none where it is more than may be asked for.
std::optional<double> press_that_would_do(const Dressing& end)
{
    constexpr double k_margin = 5e-3, k_round = 0.01;  // unit: m; the end of another run is not quite the same
    if (end.pose_reached < 1 || end.held_back.empty())
        return {};
    const double held = end.held_back.front().distance * end.to_human_size;
    const double press = k_round * std::ceil((held + k_margin) / k_round);
    return press <= k_largest_press ? std::optional(press) : std::nullopt;
}

/// The one with the tightest part, or the one that was to be put on.
std::size_t garment_too_small(const Dressing& end)
{
    return end.too_tight.empty() ? end.outermost : std::size_t(end.too_tight.front().garment);
}

/// The one that is drawn out, or else may be too small.
std::size_t garment_caught(const Dressing& end)
{
    for (std::size_t i = 0; i < end.garments.size(); ++i)
        if (is_drawn_out(end, i))
            return i;
    return garment_too_small(end);
}

std::string why_spikes(const Dressing& end, const std::string& name)
{
    std::string text = name + " could not be certified: ";
    return end.spiked_share > k_spiked_share
        ? text + "it holds parts of the body far from where they belong, at " + end.spikes.part
        : text + "its cloth is drawn out to several times its length, so it is caught";
}

std::string why_too_small(const Dressing& end, const std::vector<std::string>& names)
{
    const std::vector<TooTight> parts = tight_parts(end);
    const std::size_t garment = garment_too_small(end);
    std::ostringstream text;
    text << names[garment] << " is too small" << (end.scale_reached < 1 ? "" : " for the input pose");
    double enlargement = 0;
    for (const TooTight& part : parts) {
        text << (enlargement > 0 ? ", " : ": it lacks ") << length_text(part.missing_girth, end.unit) << " of girth at "
             << part.part;
        enlargement = std::max(enlargement, part.enlargement);
    }
    if (end.scale_reached < 1)
        text << "; a body of " << percent(end.scale_reached) << "% of the thickness would fit";
    if (!parts.empty()) {
        const double size = end.is_worn(garment) ? end.garments[garment].size * end.garments[garment].girth : 1;
        text << "; a garment " << std::ceil(100 * (enlargement + (size - 1) * (1 + enlargement))) << "% larger "
             << (size > 1 ? "than given " : "") << "would not be stretched there";
    }
    const std::optional<double> press = press_that_would_do(end);
    if (press && !end.overlaps.empty())
        text << entered_parts(end) << "; with " << rounded_text(*press, 2) << " m as press the skin gives way there";
    if (const std::optional<Fabric> fabric = fabric_that_would_do(end, garment))
        text << "; in " << fabric_names()[static_cast<int>(*fabric)] << ", which gives "
             << std::lround(100 * material_of(*fabric).largest_stretch) << "%, it would do";
    return text.str();
}

std::string why_out_of_time(const Dressing& end, const std::vector<std::string>& names)
{
    std::ostringstream text;
    text << names[end.outermost] << " could not be certified: the time limit was reached while "
         << (*end.out_of_time == Stage::drape ? "draping" : "recovering the pose");
    if (end.scale_reached < 1)
        text << ", with the body at " << percent(end.scale_reached) << "% of its size";
    else if (end.pose_reached < 1)
        text << ", at " << percent(end.pose_reached) << "% of the path between two poses";
    text << "; give more as time_limit, or 0 for no limit";
    return text.str();
}

std::string why_not_certified(const Dressing& end, const std::vector<std::string>& names)
{
    const auto crossing = std::find_if_not(end.garments.begin(), end.garments.end(),
                                           [](const WornGarment& g) { return g.certificate.clean(); });
    const bool clean = crossing == end.garments.end();
    for (std::size_t i = 0; i < end.garments.size() && clean; ++i)
        if (has_fallen_off(end, i))
            return names[i] + " could not be certified: it fell off the body; give a narrower garment";
    if (const std::size_t caught = garment_caught(end); clean && !end.out_of_time && ends_in_spikes(end, caught))
        return why_spikes(end, names[caught]);
    std::ostringstream text;
    text << names[clean ? end.outermost : crossing - end.garments.begin()] << " could not be certified: ";
    if (!clean) {
        const Certificate& c = crossing->certificate;
        text << c.body_crossings << " crossings with the body, " << c.self_crossings << " with itself, "
             << c.layer_crossings << " with layers, " << c.vertices_inside << " vertices inside";
        return text.str();
    }
    if (end.out_of_time)
        return why_out_of_time(end, names);
    if (end.pose_reached < 1)
        text << "the body stopped at " << percent(end.pose_reached) << "% of the path between two poses";
    else
        text << "parts of the body are not in their places";
    text << held_parts(end) << entered_parts(end) << "; give a wider garment, ";
    if (const std::optional<double> press = press_that_would_do(end))
        text << "a pose with more space between arms, legs and trunk, or " << rounded_text(*press, 2)
             << " m as press: the skin gives way then";
    else
        text << "or a pose with more space between arms, legs and trunk";
    return text.str();
}

}  // namespace

const Dressing* final_dressing(const Scene& scene)
{
    return scene.recovered ? &*scene.recovered : scene.draped ? &*scene.draped : nullptr;
}

int closed_ends(const Scene& scene, std::size_t garment)
{
    const Dressing* end = final_dressing(scene);
    const int of_fit = garment < scene.fits.size() ? scene.fits[garment].closed_ends : 0,
              of_worn = end && end->is_worn(garment) ? end->garments[garment].closed_ends : 0;
    return std::max(of_fit, of_worn);
}

LeftOut left_out_of(const Scene& scene, std::size_t garment)
{
    const Dressing* end = final_dressing(scene);
    if (end && end->is_worn(garment))
        return end->garments[garment].left_out;
    return garment < scene.fits.size() ? scene.fits[garment].left_out : LeftOut();
}

bool all_put_on(const Scene& scene)
{
    const auto& draped = scene.draped;
    const auto moves_on = [](const WornGarment& worn) {
        return worn.certificate.clean() || (worn.stand_in && worn.stand_in->is_clean);
    };
    return draped && draped->worn().size() == scene.garments.size() && draped->scale_reached == 1
        && draped->pose_reached == 1 && std::all_of(draped->garments.begin(), draped->garments.end(), moves_on);
}

Outcome outcome_of(const Dressing& end)
{
    if (end.certified)
        return Outcome::done;
    if (end.out_of_time)  // cloth that was not let settle may slide to where it is large enough
        return Outcome::not_certified;
    const bool too_small
        = is_too_small(end, garment_too_small(end)) && (end.scale_reached < 1 || all_clean(end.garments));
    return too_small ? Outcome::too_small : Outcome::not_certified;
}

bool is_pressed(const Dressing& end) { return end.certified && !end.held_back.empty(); }

bool is_held_back(const Dressing& end)
{
    return outcome_of(end) == Outcome::not_certified && !end.out_of_time && !end.held_back.empty();
}

bool is_held_where_body_crosses_itself(const Dressing& end)
{
    if (end.held_back.empty())
        return false;
    const std::string& furthest = end.held_back.front().part;
    return std::any_of(end.overlaps.begin(), end.overlaps.end(),
                       [&](const Overlap& overlap) { return overlap.part == furthest || overlap.other == furthest; });
}

std::string explain(const Dressing& end, const std::vector<std::string>& names)
{
    return outcome_of(end) == Outcome::too_small ? why_too_small(end, names) : why_not_certified(end, names);
}

std::string in_one_line(const std::string& name, GarmentType type, const WornGarment& garment)
{
    const Certificate& c = garment.certificate;
    const std::size_t kept = c.kept_self_crossings.size();
    std::ostringstream text;
    text << name << " (" << name_of(type) << "): " << c.body_crossings + c.self_crossings + c.layer_crossings
         << (kept > 0 ? " new" : "") << " crossings, ";
    if (kept > 0)
        text << kept << " with itself kept as given, ";
    if (c.shifted_self_crossings > 0)
        text << c.shifted_self_crossings << " between sheets that lay on each other, ";
    text << "minimum distance " << rounded_text(1000 * c.min_distance, 3) << " mm, strain "
         << rounded_text(100 * c.strain.p95, 3) << "% at the 95th percentile";
    return text.str();
}

void certify_as_kept(Dressing& dressing, const Triangles& body, const std::vector<Positions>& kept)
{
    const std::vector<std::size_t> which = dressing.worn();
    std::vector<WornGarment> worn;
    for (const std::size_t i : which) {
        worn.push_back(dressing.garments[i]);
        worn.back().positions = kept[i];
    }
    dressing.certified = certify_all(worn, { dressing.body, body }) && dressing.certified;
    for (std::size_t k = 0; k < which.size(); ++k)
        dressing.garments[which[k]] = worn[k];
}

std::vector<std::string> explain(const std::vector<FitConflict>& conflicts, const std::vector<std::string>& names)
{
    std::map<std::pair<int, int>, std::string> bones_of;
    for (const FitConflict& conflict : conflicts) {
        std::string& bones = bones_of[std::minmax(conflict.garments[0], conflict.garments[1])];
        bones += (bones.empty() ? "" : ", ") + std::string(bone_name(conflict.bone)) + " by "
            + std::to_string(std::lround(k_degrees_per_radian * conflict.angle));
    }
    std::vector<std::string> lines;
    for (const auto& [garments, bones] : bones_of)
        lines.push_back("no one pose serves " + names[garments.first] + " and " + names[garments.second]
                        + ": each needs some bones in other directions (degrees: " + bones
                        + "); the body moves from one pose to the next");
    return lines;
}

int percent(double share) { return static_cast<int>(std::floor(100 * share)); }

}  // namespace garmentfit
