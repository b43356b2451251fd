// SPDX-License-Identifier: GPL-3.0-or-later
#include "coverage.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "garmentfit/error.h"
#include "tuning.h"

namespace garmentfit {
namespace {

constexpr std::size_t k_min_openings = 2;  // derived: a body goes in by one and looks out of another

bool has(const std::vector<Bone>& bones, Bone bone)
{
    return std::find(bones.begin(), bones.end(), bone) != bones.end();
}

bool is_on_legs(Bone bone)
{
    return bone == lhipjoint || bone == rhipjoint || bone == lfemur || bone == rfemur || bone == ltibia
        || bone == rtibia;
}

bool is_on_shins(Bone bone) { return bone == ltibia || bone == rtibia; }

bool covers(CoverageKind kind, Bone bone)
{
    const bool trunk = kind != CoverageKind::legs && kind != CoverageKind::skirt, thighs = kind != CoverageKind::top,
               shins = kind == CoverageKind::legs || kind == CoverageKind::jumpsuit;
    return is_on_shins(bone) ? shins : is_on_legs(bone) ? thighs : trunk;
}

GarmentType name_top(const std::vector<Bone>& bones)
{
    return has(bones, lradius) ? GarmentType::longsleeve
        : has(bones, lhumerus) ? GarmentType::tshirt
                               : GarmentType::vest;
}

GarmentType name_coverage(CoverageKind kind, const std::vector<Bone>& bones, const std::vector<Opening>& openings)
{
    switch (kind) {
    case CoverageKind::top: return name_top(bones);
    case CoverageKind::legs: return GarmentType::trousers;
    case CoverageKind::skirt: return cues_of(openings).hems.empty() ? GarmentType::skirt : GarmentType::shorts;
    case CoverageKind::dress: return GarmentType::dress;
    case CoverageKind::jumpsuit: return GarmentType::jumpsuit;
    }
    return GarmentType::automatic;
}

double name_probability(double confidence)
{
    return 1
        / (1 + std::exp(-(garment_tuning::k_name_log_odds + garment_tuning::k_name_confidence_log_odds * confidence)));
}

// The sleeves are those of the openings; and so are bare shoulders, but in tops: ponchos have no openings for arms.
Coverage coverage_of(CoverageKind kind, const std::vector<Opening>& openings)
{
    Coverage coverage { kind, GarmentType::automatic, {}, false, name_probability(0) };
    const GarmentType whole = kind == CoverageKind::top ? GarmentType::suit : GarmentType::jumpsuit;
    for (const Bone bone : bones_covered_by(whole, openings))
        if (covers(kind, bone))
            coverage.bones.push_back(bone);
    coverage.type = name_coverage(kind, coverage.bones, openings);
    return coverage;
}

/// A top that begins below the shoulders: of two openings alone, as those of a poncho.
Coverage strapless_top()
{
    return { CoverageKind::top, GarmentType::strapless, bones_covered_by(GarmentType::strapless), false,
             name_probability(0) };
}

InvalidInput no_type(const std::vector<Opening>& openings)
{
    return { ErrorCode::no_opening,
             std::string("garment: its type cannot be guessed, because it has ")
                 + (openings.size() == 1 ? "only one opening" : "no openings")
                 + " large enough for a body; give its type, or a garment with openings" };
}

/// Whether a garment of which a coarse word was said, or nothing, may be of a kind.
bool allows(GarmentType said, CoverageKind kind)
{
    switch (said) {
    case GarmentType::top: return kind == CoverageKind::top;
    case GarmentType::bottom: return kind == CoverageKind::legs || kind == CoverageKind::skirt;
    case GarmentType::whole: return kind == CoverageKind::dress || kind == CoverageKind::jumpsuit;
    default: return true;
    }
}

}  // namespace

GarmentType type_when_worn(GarmentType found, const std::vector<Bone>& covered)
{
    const bool is_short = found == GarmentType::trousers && !has(covered, ltibia) && !has(covered, rtibia);
    return is_short ? GarmentType::shorts : found;
}

CoverageKind coverage_kind_of(GarmentType type)
{
    switch (type) {
    case GarmentType::leggings:
    case GarmentType::trousers: return CoverageKind::legs;
    case GarmentType::hotpants:
    case GarmentType::shorts:
    case GarmentType::skirt: return CoverageKind::skirt;
    case GarmentType::coat:
    case GarmentType::robe:
    case GarmentType::dress: return CoverageKind::dress;
    case GarmentType::jumpsuit:
    case GarmentType::overalls:
    case GarmentType::suit: return CoverageKind::jumpsuit;
    default: return CoverageKind::top;
    }
}

std::vector<Coverage> possible_coverages(GarmentType given, const std::vector<Opening>& openings)
{
    const bool is_given = given != GarmentType::automatic && !is_coarse(given);
    const TypeGuess guessed = is_given ? TypeGuess { given, 1 } : guess_type(openings);
    const GarmentType guess = guessed.type;
    std::vector<Coverage> coverages;
    if (guess != GarmentType::automatic && (is_given || allows(given, coverage_kind_of(guess))))
        coverages.push_back({ coverage_kind_of(guess), guess, bones_covered_by(guess, openings), true,
                              is_given ? 1 : name_probability(guessed.confidence) });
    else if (given == GarmentType::automatic && openings.size() < k_min_openings)
        throw no_type(openings);
    for (int kind = 0; kind < int(k_coverage_kind_names.size()) && !is_given; ++kind)
        if (allows(given, CoverageKind(kind)) && (coverages.empty() || coverages[0].kind != CoverageKind(kind)))
            coverages.push_back(coverage_of(CoverageKind(kind), openings));
    if (!is_given && allows(given, CoverageKind::top) && cues_of(openings).is_strapless)
        coverages.push_back(strapless_top());
    return coverages;
}

GarmentType resolve_type(GarmentType given, const std::vector<Opening>& openings)
{
    if (given == GarmentType::automatic && guess_type(openings).type == GarmentType::automatic)
        throw no_type(openings);
    return possible_coverages(given, openings).front().type;
}

}  // namespace garmentfit
