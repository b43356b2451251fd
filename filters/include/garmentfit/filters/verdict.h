// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// How a garment fits, in one word: by girth, by what its fabric gives, and by the pressure on the skin.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "garmentfit/filters/filters.h"

namespace garmentfit {

/// too_large: it does not stay where it is worn.
enum class Verdict { roomy, fits, tight, too_small, too_large };
/// "roomy", "fits", "tight", "too small", "too large".
std::string_view name_of(Verdict verdict);

struct PlaceVerdict {
    std::string place;  ///< as in Girth and TooTight
    Verdict verdict;
    double stretch;  ///< l / l0 - 1 of the cloth round that place, on the mean; 0 where it was not measured
    double pressure;  ///< Pa, on the mean; 0 likewise
};

struct FitVerdict {
    Verdict verdict;  ///< of the whole: the worst, where too small is worst, then too large, tight, fits, roomy
    std::vector<PlaceVerdict> places;  ///< from the neck down as Girth, then what has no girth
    std::optional<Fabric> would_do;  ///< of a garment that is too small: the least stretchy fabric in which it is not
};

/// By these rules, for each place round which the garment goes:
/// too small  stretched by more than the fabric gives (Dressing::too_tight);
/// tight      pressure over 1.96 kPa, or stretched by more than half of what the fabric gives;
/// roomy      14 % of ease or more;
/// fits       otherwise.
/// A garment that does not stay where it is worn (has_slipped) is too large. One that is roomy is so everywhere.
/// None for a garment that is not worn for another reason than being too small.
/// Cost O(parts).
std::optional<FitVerdict> fit_verdict(const Dressing& dressing, std::size_t garment);

/// ", tight", to follow in_one_line; empty where there is no verdict.
std::string verdict_in_words(const Dressing& dressing, std::size_t garment);

/// Whether the garment is too small: it is too tight in places, or the body could not get its full size in it. Never
/// where body or cloth ends in spikes, or time ran out.
bool is_too_small(const Dressing& dressing, std::size_t garment);
/// Whether the garment slipped down further than cloth sinks that settles.
bool has_slipped_down(const Dressing& dressing, std::size_t garment);
/// Whether it does not stay where it is worn: it slipped down, off a shoulder, or below hips that it should cover.
bool has_slipped(const Dressing& dressing, std::size_t garment);
/// Whether a piece of the garment went away from the cloth on which it lay.
bool has_lost_a_piece(const Dressing& dressing, std::size_t garment);
/// Whether an edge is drawn out to several times its length: it is caught on something. Short ones are pinched, such as
/// those of a button's rim.
bool is_torn(const Dressing& dressing, std::size_t garment);
/// The first garment of which one of these is true; none where it is true of none.
std::optional<std::size_t> first_garment(const Dressing& dressing, bool (*is)(const Dressing&, std::size_t));
/// Whether an edge is far longer than at rest, or triangles have gained much area: cloth that is caught, and no dressing,
/// though nothing crosses.
bool is_drawn_out(const Dressing& dressing, std::size_t garment);

/// Whether all of it lies below the body.
bool has_fallen_off(const Dressing& dressing, std::size_t garment);
/// A hundredth of the body's edges or a twentieth of the garment's are drawn out to three times their length, or the
/// garment is drawn out: no girth is missing, but something is caught.
bool ends_in_spikes(const Dressing& dressing, std::size_t garment);
/// The fabric in which a garment that is too small would do; none where there is none.
std::optional<Fabric> fabric_that_would_do(const Dressing& dressing, std::size_t garment);

}  // namespace garmentfit
