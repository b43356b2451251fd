// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/filters/warnings.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "garmentfit/filters/given_rig.h"
#include "garmentfit/filters/outcome.h"
#include "garmentfit/filters/verdict.h"
#include "garmentfit/number_text.h"
#include "tuning.h"

namespace garmentfit {
namespace {

constexpr const char* k_guess = " is guessed with low confidence";

std::string percent_text(double probability)
{
    return " (probability " + std::to_string(std::lround(100 * probability)) + "%)";
}

std::string percent_of(double share) { return std::to_string(std::lround(100 * share)) + "%"; }

void warn_of_guesses(std::vector<std::string>& warnings, const std::string& name, const FitResult& fit,
                     const HowToSet& set)
{
    if (fit.type_probability < k_low_probability)
        warnings.push_back("the type of " + name + " is uncertain: " + std::string(name_of(fit.type))
                           + percent_text(fit.type_probability) + "; if it is wrong, " + set("type"));
    if (fit.front_probability < k_low_probability)
        warnings.push_back("the front of " + name + " is uncertain" + percent_text(fit.front_probability)
                           + "; if it is worn back to front, " + set("garment_front"));
    if (fit.up_probability < k_low_probability)
        warnings.push_back("which end of " + name + " is up is uncertain" + percent_text(fit.up_probability)
                           + "; if it is worn upside down or on its side, " + set("garment_up"));
}

void warn_of_garment(std::vector<std::string>& warnings, const std::string& name, const Dressing& end,
                     std::size_t index)
{
    const WornGarment& garment = end.garments[index];
    if (garment.size > 1)
        warnings.push_back(name + " was made " + std::to_string(std::lround(100 * (garment.size - 1))) + "% larger");
    if (garment.size < 1)
        warnings.push_back(name + " was made " + std::to_string(std::lround(100 * (1 - garment.size)))
                           + "% smaller, as it slips off this body in the size guessed; to keep that, give its unit");
    if (garment.girth > 1)
        warnings.push_back(name + " was made up to " + std::to_string(std::lround(100 * (garment.girth - 1)))
                           + "% wider where it was too small, its lengths are as given");
    if (const std::size_t kept = garment.certificate.kept_self_crossings.size(); kept > 0)
        warnings.push_back(name + " crossed itself as it was given, and could not be parted everywhere: "
                           + std::to_string(kept) + " of " + std::to_string(garment.certificate.input_self_crossings)
                           + " crossings are left");
    if (const PieceCounts& pieces = garment.pieces; pieces.free > 0)
        warnings.push_back(name + " has " + std::to_string(pieces.count) + " pieces, of which "
                           + std::to_string(pieces.free)
                           + (pieces.free == 1 ? " lies on no other; it is a layer of its own"
                                               : " lie on no other; they are layers of their own"));
    if (has_lost_a_piece(end, index))
        warnings.push_back(
            "a piece of " + name + " went " + length_text(garment.piece_shift, end.unit)
            + " away from the cloth that it lay on; join its border to that cloth in the garment's file");
    if (has_slipped_down(end, index))
        warnings.push_back(name + " slipped down by " + length_text(garment.slipped, end.unit)
                           + ": it is too wide for this body to stay where it is worn");
}

std::string warning_about_pressed(const Dressing& end)
{
    std::string parts;
    for (const HeldBack& part : end.held_back)
        parts += (parts.empty() ? "" : ", ") + part.part + " (by " + length_text(part.distance, end.unit) + ")";
    return "cloth presses the skin in at " + parts
        + ": the result is certified on the body so pressed, and crosses the body as it was given there";
}

std::string shoulders_in_words(const std::vector<Bone>& clavicles)
{
    return clavicles.size() == 2    ? "both shoulders"
        : clavicles[0] == lclavicle ? "the left shoulder"
                                    : "the right shoulder";
}

std::string hips_in_words(const std::vector<Bone>& hips)
{
    return hips.size() == 2 ? "the hips" : hips[0] == lhipjoint ? "the left hip" : "the right hip";
}

std::string warning_about_guessed_fabric(const std::string& name, Fabric fabric)
{
    const auto name_of = [](Fabric f) { return std::string(fabric_names()[static_cast<int>(f)]); };
    return name + " is too small in " + name_of(ClothOptions().fabric) + ", so it was taken to be of " + name_of(fabric)
        + ", as most clothes of its type are; if it is not, give its fabric";
}

/// Of one that is worn; whether it is tight, too.
void warn_of_worn(std::vector<std::string>& warnings, const std::string& name, const Dressing& end, std::size_t garment)
{
    warn_of_garment(warnings, name, end, garment);
    if (garment < end.guessed_fabrics.size() && end.guessed_fabrics[garment])
        warnings.push_back(warning_about_guessed_fabric(name, end.fabrics[garment]));
    if (garment < end.off_shoulders.size() && !end.off_shoulders[garment].empty())
        warnings.push_back(name + " slipped off " + shoulders_in_words(end.off_shoulders[garment])
                           + ": it is too wide there for this body to stay where it is worn");
    if (garment < end.below_hips.size() && !end.below_hips[garment].empty())
        warnings.push_back(name + " hangs below " + hips_in_words(end.below_hips[garment])
                           + ", which it should cover: it does not stay on this body");
    const std::optional<FitVerdict> verdict = fit_verdict(end, garment);
    if (!verdict || verdict->verdict != Verdict::tight)
        return;
    std::string places;
    for (const PlaceVerdict& place : verdict->places)
        if (place.verdict == Verdict::tight)
            places += (places.empty() ? "" : ", ") + place.place + " (" + percent_of(place.stretch) + ", "
                + rounded_text(place.pressure / 1000, 2) + " kPa)";
    warnings.push_back(name + " is tight at " + places);
}

void warn_of_closed_ends(std::vector<std::string>& warnings, const std::string& name, int closed_ends)
{
    if (closed_ends > 0)
        warnings.push_back(name + " has " + std::to_string(closed_ends)
                           + (closed_ends == 1 ? " end that is closed" : " ends that are closed")
                           + "; taken as openings, and not kept clear of the body");
}

std::string count_text(int count, const std::string& noun)
{
    return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

void warn_of_left_out(std::vector<std::string>& warnings, const std::string& name, const LeftOut& left_out)
{
    std::string pieces;
    const auto add = [&pieces](int count, const std::string& noun, const std::string& after, const std::string& where) {
        if (count > 0)
            pieces += (pieces.empty() ? "" : after) + count_text(count, noun) + where;
    };
    add(left_out.solids, "solid", "", left_out.lids > 0 ? "" : " inside");
    add(left_out.lids, "lid", " and ", " inside");
    add(left_out.specks, "speck", ", and ", " far from the cloth");
    add(left_out.backdrops, "backdrop", ", and ", " beside it");
    if (left_out.garments > 0)
        warnings.push_back(
            name + " has " + count_text(left_out.garments, "other garment")
            + " beside it; left out, and drawn into one point of the cloth; to dress in another one, give"
              " it in a file of its own");
    if (!pieces.empty())
        warnings.push_back(name + " has " + pieces + " (" + count_text(left_out.faces, "face")
                           + "); taken for no cloth, left out, and drawn into one point of the cloth");
}

bool is_upside_down(const Skeleton& skeleton)
{
    const double hips = skeleton.root.y();
    return std::min(skeleton.tail(ltibia).y(), skeleton.tail(rtibia).y()) > hips && skeleton.tips[head_top].y() < hips;
}

std::string overstretched_edges(const std::string& name, const Overstretch& stretch)
{
    std::ostringstream text;
    text << name << " is overstretched: " << stretch.edges << (stretch.edges == 1 ? " edge" : " edges")
         << " by more than " << percent(stretch.limit) << "%, the most by " << std::lround(100 * stretch.largest)
         << "%, at " << stretch.part;
    return text.str();
}

std::string share_of_weight(double share)
{
    constexpr double k_many = 10;  // unit: from there on a percentage says no more than "far"
    return share > k_many ? "more than " + rounded_text(k_many, 2) + " times its weight"
                          : std::to_string(std::lround(100 * share)) + " % of its weight";
}

}  // namespace

std::string set_by_name(std::string_view parameter) { return "set " + std::string(parameter); }

std::vector<std::string> warnings_about_frame(const std::string& mesh, const FrameGuess& guess,
                                              const std::string& prefix, const HowToSet& set)
{
    std::vector<std::string> warnings;
    if (guess.unit_confidence < k_low_confidence)
        warnings.push_back("the unit of " + mesh + k_guess + " (" + guess.why + "); if it is wrong, "
                           + set(prefix + "unit"));
    if (guess.scale != 1)
        warnings.push_back(mesh + " fits the body in the guessed unit nowhere: it was scaled by "
                           + rounded_text(guess.scale, 3) + percent_text(guess.scale_probability) + " (" + guess.why
                           + "); if it is wrong, " + set(prefix + "unit") + ", and " + set(prefix + "scale")
                           + " where the unit is not enough");
    else if (guess.scale_probability < k_low_probability)
        warnings.push_back("the size of " + mesh + " is uncertain" + percent_text(guess.scale_probability) + " ("
                           + guess.why + "); if it is wrong, " + set(prefix + "unit") + ", or "
                           + set(prefix + "scale"));
    if (guess.up_confidence < k_low_confidence)
        warnings.push_back("the up axis of " + mesh + k_guess + " (" + guess.why + "); if it is wrong, "
                           + set(prefix + "up"));
    return warnings;
}

std::vector<std::string> warnings_about_left_behind(const MeshFile& garment)
{
    std::string left;
    for (const std::string& part : garment.left_behind())
        left += (left.empty() ? "" : ", ") + part;
    if (left.empty())
        return {};
    return { garment.path().filename().string() + " has " + left
             + "; they belong to the shape in the file, and the dressed garment has none" };
}

std::string warning_about_figure(const Rig& rig, const HowToSet& set)
{
    if (rig.human_probability < k_hopeless_figure)
        return "the skeleton is probably wrong, as the body is hardly like a human (probability below "
            + rounded_text(100 * k_hopeless_figure, 1) + "%): " + rig.not_human + "; correct its joints (joints), or "
            + set("humanlike") + " strict to have such bodies refused";
    return "the body is far from human" + percent_text(rig.human_probability) + ": " + rig.not_human
        + "; look at its joints, and correct them (joints) if they are wrong";
}

std::vector<std::string> warnings_about_rig(const Scene& scene, const HowToSet& set)
{
    std::vector<std::string> warnings;
    if (!scene.rig)
        return warnings;
    if (is_upside_down(scene.rig->skeleton))
        warnings.push_back("the feet of the body are above its hips and its head is below; if it does not stand on its "
                           "head, "
                           + set("up"));
    if (scene.rig->side_confidence < k_low_confidence)
        warnings.push_back(std::string("which side of the body is left") + k_guess + "; if it is wrong, "
                           + set("swap_sides"));
    if (scene.rig->human_probability < k_far_from_human)
        warnings.push_back(warning_about_figure(*scene.rig, set));
    return warnings;
}

std::vector<std::string> warnings_about_given_rig(const Rig& rig, const BodyMesh& body, const std::string& called)
{
    const std::string doubt = doubt_about(rig, body);
    if (doubt.empty())
        return {};
    return { called + " may be wrong: " + doubt };
}

std::vector<std::string> warnings_about_fits(const Scene& scene, const std::vector<std::string>& names,
                                             const HowToSet& set)
{
    std::vector<std::string> warnings = explain(scene.conflicts, names);
    for (std::size_t i = 0; i < scene.fits.size(); ++i)
        warn_of_guesses(warnings, names[i], scene.fits[i], set);
    for (std::size_t i = 0; i < scene.garments.size(); ++i) {
        warn_of_closed_ends(warnings, names[i], closed_ends(scene, i));
        warn_of_left_out(warnings, names[i], left_out_of(scene, i));
    }
    return warnings;
}

std::vector<std::string> warnings_about_layers(const Scene& scene, const std::vector<std::string>& names,
                                               const HowToSet& set)
{
    bool same = true;
    std::vector<std::string> in_order(scene.automatic_layers.size());
    for (std::size_t i = 0; i < in_order.size(); ++i) {
        in_order[scene.automatic_layers[i]] = names[i];
        same &= scene.automatic_layers[i] == scene.fits[i].layer;
    }
    if (same)
        return {};
    std::string order;
    for (const std::string& name : in_order)
        order += (order.empty() ? "" : ", ") + name;
    return { "types and widths of the garments suggest another order, from the inside out: " + order
             + "; give them in this order, or " + set("layer_order") + " auto" };
}

std::vector<std::string> warnings_about_dressing(const Dressing& end, const std::vector<std::string>& names)
{
    std::vector<std::string> warnings;
    if (is_pressed(end))
        warnings.push_back(warning_about_pressed(end));
    if (end.residual && !end.residual->is_at_rest())
        warnings.push_back("the cloth is not at rest: forces on it are out of balance by "
                           + share_of_weight(end.residual->mean) + " on the mean; "
                           + (end.out_of_time ? "give more time as time_limit: it was reached"
                                              : "cloth that passes through itself, is far too tight, or has small "
                                                "pieces on it, such as buttons, may have no rest, and quality draft "
                                                "looks for none"));
    for (std::size_t i = 0; i < names.size(); ++i)
        if (end.is_worn(i))
            warn_of_worn(warnings, names[i], end, i);
        else if (is_too_small(end, i))
            warnings.push_back(names[i]
                               + " is left out of the result: it is too small to go over body and garments under it");
        else if (end.out_of_time)
            warnings.push_back(names[i] + " was not put on within the time limit");
        else
            warnings.push_back(names[i] + " was not put on, because the garments under it were not certified");
    for (std::size_t i = 0; i < end.overstretches.size(); ++i)
        if (end.overstretches[i].edges > 0)
            warnings.push_back(overstretched_edges(names[i], end.overstretches[i]));
    if (int(end.frames.size()) < end.frames_asked)
        warnings.push_back("of " + std::to_string(end.frames_asked) + " frames there are "
                           + std::to_string(end.frames.size()) + ": frames that cannot be certified are left out");
    return warnings;
}

std::vector<std::string> warnings_about_scene(const Scene& scene, const std::vector<std::string>& names,
                                              const HowToSet& set)
{
    std::vector<std::string> warnings = warnings_about_rig(scene, set);
    const auto add
        = [&](const std::vector<std::string>& more) { warnings.insert(warnings.end(), more.begin(), more.end()); };
    add(warnings_about_fits(scene, names, set));
    add(warnings_about_layers(scene, names, set));
    if (const Dressing* end = final_dressing(scene))
        add(warnings_about_dressing(*end, names));
    return warnings;
}

}  // namespace garmentfit
