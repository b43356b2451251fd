// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/filters/verdict.h"

#include <algorithm>
#include <array>

#include "tuning.h"

namespace garmentfit {
namespace {

double fabric_stretch(const Dressing& dressing, std::size_t garment)
{
    return garment < dressing.fabric_stretches.size() ? dressing.fabric_stretches[garment]
                                                      : material_of(Fabric::cotton).largest_stretch;
}

bool is_too_tight(const Dressing& dressing, std::size_t garment)
{
    return std::any_of(dressing.too_tight.begin(), dressing.too_tight.end(),
                       [&](const TooTight& part) { return part.garment == int(garment); });
}

bool is_too_tight_at(const Dressing& dressing, std::size_t garment, const std::string& place)
{
    return std::any_of(dressing.too_tight.begin(), dressing.too_tight.end(),
                       [&](const TooTight& part) { return part.garment == int(garment) && part.part == place; });
}

/// @param ease  share of the body's girth, where it was measured
PlaceVerdict judge_place(const Dressing& dressing, std::size_t garment, const std::string& place,
                         std::optional<double> ease)
{
    PlaceVerdict result { place, Verdict::fits, 0, 0 };
    if (garment < dressing.loads.size())
        for (const PartLoad& load : dressing.loads[garment])
            if (load.part == place) {
                result.stretch = load.stretch;
                result.pressure = load.pressure;
            }
    if (is_too_tight_at(dressing, garment, place))
        result.verdict = Verdict::too_small;
    else if (result.pressure > k_comfortable_pressure
             || result.stretch > k_tight_share * fabric_stretch(dressing, garment))
        result.verdict = Verdict::tight;
    else if (ease && *ease >= k_roomy_ease)
        result.verdict = Verdict::roomy;
    return result;
}

std::vector<PlaceVerdict> judge_places(const Dressing& dressing, std::size_t garment)
{
    std::vector<PlaceVerdict> places;
    const auto is_new = [&](const std::string& place) {
        return std::none_of(places.begin(), places.end(), [&](const PlaceVerdict& one) { return one.place == place; });
    };
    if (garment < dressing.girths.size())
        for (const Girth& girth : dressing.girths[garment])
            places.push_back(judge_place(dressing, garment, girth.place,
                                         girth.body > 0 ? std::optional(girth.ease() / girth.body) : std::nullopt));
    if (garment < dressing.loads.size())
        for (const PartLoad& load : dressing.loads[garment])
            if (is_new(load.part))
                places.push_back(judge_place(dressing, garment, load.part, {}));
    for (const TooTight& part : dressing.too_tight)
        if (part.garment == int(garment) && is_new(part.part))
            places.push_back(judge_place(dressing, garment, part.part, {}));
    return places;
}

}  // namespace

bool has_slipped_down(const Dressing& dressing, std::size_t garment)
{
    return dressing.garments[garment].slipped * dressing.to_human_size > k_slipped;
}

bool has_slipped(const Dressing& dressing, std::size_t garment)
{
    const auto has_any
        = [&](const std::vector<std::vector<Bone>>& off) { return garment < off.size() && !off[garment].empty(); };
    return dressing.is_worn(garment)
        && (has_slipped_down(dressing, garment) || has_any(dressing.off_shoulders) || has_any(dressing.below_hips));
}

bool has_lost_a_piece(const Dressing& dressing, std::size_t garment)
{
    return dressing.garments[garment].piece_shift * dressing.to_human_size > k_piece_gone;
}

std::string_view name_of(Verdict verdict)
{
    constexpr std::array<std::string_view, 5> k_names { "roomy", "fits", "tight", "too small", "too large" };
    return k_names[static_cast<std::size_t>(verdict)];
}

bool is_torn(const Dressing& dressing, std::size_t garment)
{
    if (garment >= dressing.overstretches.size())
        return false;
    const Overstretch& stretch = dressing.overstretches[garment];
    return stretch.largest > k_torn && stretch.longer * dressing.to_human_size > k_torn_length;
}

std::optional<std::size_t> first_garment(const Dressing& dressing, bool (*is)(const Dressing&, std::size_t))
{
    for (std::size_t i = 0; i < dressing.garments.size(); ++i)
        if (is(dressing, i))
            return i;
    return {};
}

bool is_drawn_out(const Dressing& dressing, std::size_t garment)
{
    if (garment >= dressing.overstretches.size())
        return false;
    const Overstretch& stretch = dressing.overstretches[garment];
    return stretch.longer * dressing.to_human_size > k_strand
        || (stretch.gained > k_drawn_area && !is_too_tight(dressing, garment));
}

bool has_fallen_off(const Dressing& dressing, std::size_t garment)
{
    return dressing.is_worn(garment) && dressing.body.rows() > 0
        && dressing.garments[garment].positions.col(1).maxCoeff() < dressing.body.col(1).minCoeff();
}

bool ends_in_spikes(const Dressing& dressing, std::size_t garment)
{
    return dressing.spiked_share > k_spiked_share || is_drawn_out(dressing, garment)
        || (garment < dressing.garments.size() && dressing.garments[garment].certificate.strain.p95 > k_torn);
}

bool is_too_small(const Dressing& dressing, std::size_t garment)
{
    if (ends_in_spikes(dressing, garment))
        return false;
    return (garment == dressing.outermost && dressing.scale_reached < 1 && !dressing.out_of_time)
        || is_too_tight(dressing, garment);
}

std::optional<Fabric> fabric_that_would_do(const Dressing& dressing, std::size_t garment)
{
    double needed = 0;
    for (const TooTight& part : dressing.too_tight)
        if (part.garment == int(garment))
            needed = std::max(needed, part.enlargement);
    if (needed == 0)
        return {};
    return fabric_that_gives(needed, fabric_stretch(dressing, garment));
}

std::optional<FitVerdict> fit_verdict(const Dressing& dressing, std::size_t garment)
{
    const bool too_small = is_too_small(dressing, garment);
    if (!too_small && !dressing.is_worn(garment))
        return {};
    FitVerdict result { Verdict::fits, judge_places(dressing, garment), {} };
    const auto is
        = [](Verdict verdict) { return [verdict](const PlaceVerdict& one) { return one.verdict == verdict; }; };
    const auto& places = result.places;
    if (too_small) {
        result.verdict = Verdict::too_small;
        result.would_do = fabric_that_would_do(dressing, garment);
    } else if (has_slipped(dressing, garment)) {
        result.verdict = Verdict::too_large;
    } else if (std::any_of(places.begin(), places.end(), is(Verdict::tight))) {
        result.verdict = Verdict::tight;
    } else if (!places.empty() && std::all_of(places.begin(), places.end(), is(Verdict::roomy))) {
        result.verdict = Verdict::roomy;
    }
    return result;
}

std::string verdict_in_words(const Dressing& dressing, std::size_t garment)
{
    const std::optional<FitVerdict> verdict = fit_verdict(dressing, garment);
    return verdict ? ", " + std::string(name_of(verdict->verdict)) : "";
}

}  // namespace garmentfit
