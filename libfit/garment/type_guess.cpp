// SPDX-License-Identifier: GPL-3.0-or-later
#include "type_guess.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "garmentfit/error.h"
#include "outward_cloth.h"

namespace garmentfit {
namespace {

const std::vector<Bone> k_trunk { lowerback, upperback, thorax, lclavicle, rclavicle };
const std::vector<Bone> k_upper_arms { lhumerus, rhumerus };
const std::vector<Bone> k_forearms { lradius, rradius };
const std::vector<Bone> k_thighs { lhipjoint, rhipjoint, lfemur, rfemur };
const std::vector<Bone> k_shins { ltibia, rtibia };

std::vector<Bone> together(std::initializer_list<std::vector<Bone>> groups)
{
    std::vector<Bone> bones;
    for (const auto& group : groups)
        bones.insert(bones.end(), group.begin(), group.end());
    std::sort(bones.begin(), bones.end());
    return bones;
}

constexpr double k_armhole = 0.55;  // of armhole_likeness; sleeves have 0.1 to 0.4, a vest 0.7
constexpr double k_armhole_length = 0.25;  // girths at most; a T-shirt's sleeve has 0.35
constexpr double k_long_sleeve = 0.9;  // girths; to the elbow 0.5, to the wrist 1.4

// One connected piece of cloth, its openings told apart.
struct Piece {
    std::vector<Opening> sleeves, legs;  // two each, or none
    std::vector<Opening> others;  // neck, hem, waist, an open front
    double height = 0;  // m
    double middle = 0;  // m; arms are above it, also below a hood
    double margin = 1;  // of the closest decision so far

    // Is `value` above `threshold`? Half as much again is clear.
    bool above(double value, double threshold)
    {
        margin = std::min(margin, 2 * std::abs(value - threshold) / threshold);
        return value > threshold;
    }
};

// Mirror images: equal girths, equal heights, to the two sides of the piece.
bool are_pair(const Opening& a, const Opening& b)
{
    Vec3 across = b.centre - a.centre;
    const double lift = std::exchange(across.y(), 0);
    return std::max(a.girth, b.girth) < 1.4 * std::min(a.girth, b.girth) && std::abs(lift) < 0.15 * a.piece_height
        && across.norm() > 0.25 * std::max(a.girth, b.girth) && face_alike(a, b, across.normalized());
}

std::vector<Opening> take_pair(std::vector<Opening>& from, std::size_t i, std::size_t j)
{
    const std::vector<Opening> pair { from[i], from[j] };
    from.erase(from.begin() + j);
    from.erase(from.begin() + i);
    return pair;
}

// Legs are the lowest two openings; a hem that reaches as low, or hangs between them, makes them sleeves.
void take_legs(Piece& piece)
{
    auto& all = piece.others;
    if (all.size() < 3 || !are_pair(all[0], all[1]) || all[0].facing.y() > -0.5 || all[1].facing.y() > -0.5)
        return;
    for (std::size_t i = 2; i < all.size(); ++i)
        if (all[i].facing.y() < -0.8 || all[i].low.y() < std::max(all[0].high.y(), all[1].high.y()))
            return;
    if (all.back().facing.y() > -0.3)  // or it is a jacket that lies on its back
        piece.legs = take_pair(all, 0, 1);
}

// Arms are thinner than the trunk, and so are their openings.
bool are_narrow(const Opening& a, const Opening& b, const Piece& piece)
{
    constexpr double k_narrow = 0.9;
    double widest = 0;
    for (const Opening& other : piece.others)
        if (&other != &a && &other != &b)
            widest = std::max(widest, other.girth);
    return !piece.legs.empty() || std::max(a.girth, b.girth) < k_narrow * widest;
}

// One sleeve, a tube, and across the chest an armhole, with a hem below.
bool are_sleeve_and_armhole(const Opening& sleeve, const Opening& armhole, const Piece& piece)
{
    constexpr double k_tube = 0.25;  // girths long at least
    const Vec3 across = (armhole.centre - sleeve.centre).normalized();
    const double facing = std::min(-sleeve.facing.dot(across), armhole.facing.dot(across));
    const bool is_missing = sleeve.girth < armhole.girth  // or cut off, to a stub
        || (sleeve.girth < 1.25 * armhole.girth && sleeve.tube_length > 2 * armhole.tube_length);
    const bool has_hem = std::any_of(piece.others.begin(), piece.others.end(), [&](const Opening& other) {
        return other.facing.y() < -0.6 && other.low.y() < std::min(sleeve.low.y(), armhole.low.y());
    });
    return sleeve.tube_length > k_tube * sleeve.tube_girth && is_missing && facing > 0.5 && std::abs(across.y()) < 0.6
        && armhole.centre.y() > piece.middle && (has_hem || !piece.legs.empty());
}

// What is missing has no length.
std::vector<Opening> take_sleeve_and_armhole(std::vector<Opening>& from, std::size_t sleeve, std::size_t armhole)
{
    from[armhole].tube_length = 0;
    return take_pair(from, std::min(sleeve, armhole), std::max(sleeve, armhole));
}

void take_sleeves(Piece& piece)
{
    auto& all = piece.others;
    for (std::size_t i = 0; i < all.size() && piece.sleeves.empty(); ++i)
        for (std::size_t j = i + 1; j < all.size() && piece.sleeves.empty(); ++j) {
            const Vec3 across = all[j].centre - all[i].centre;
            if (are_pair(all[i], all[j]) && all[i].facing.dot(across) < 0 && all[j].facing.dot(across) > 0
                && are_narrow(all[i], all[j], piece))
                piece.sleeves = take_pair(all, i, j);
        }
    for (std::size_t i = 0; i < all.size() && piece.sleeves.empty(); ++i)
        for (std::size_t j = 0; j < all.size() && piece.sleeves.empty(); ++j)
            if (i != j && are_sleeve_and_armhole(all[i], all[j], piece) && are_narrow(all[i], all[j], piece))
                piece.sleeves = take_sleeve_and_armhole(all, i, j);
}

std::vector<Piece> pieces_of(const std::vector<Opening>& openings)
{
    std::map<int, std::vector<Opening>> by_piece;
    for (const Opening& opening : openings)
        by_piece[opening.piece].push_back(opening);
    std::vector<Piece> pieces;
    for (auto& [name, some] : by_piece) {
        std::sort(some.begin(), some.end(), [](const auto& a, const auto& b) { return a.centre.y() < b.centre.y(); });
        Piece piece;
        piece.height = some[0].piece_height;
        piece.middle = some[0].piece_low + 0.45 * piece.height;
        piece.others = some;
        take_legs(piece);
        take_sleeves(piece);
        pieces.push_back(piece);
    }
    return pieces;
}

double length_in_girths(const std::vector<Opening>& pair)
{
    return std::max(pair[0].tube_length / pair[0].tube_girth, pair[1].tube_length / pair[1].tube_girth);
}

double length_of(const std::vector<Opening>& pair) { return std::max(pair[0].tube_length, pair[1].tube_length); }

GarmentType type_with_legs(Piece& piece)
{
    if (!piece.sleeves.empty() || piece.above(piece.height / length_of(piece.legs), 1.5))
        return GarmentType::jumpsuit;
    return piece.above(length_in_girths(piece.legs), 1.0) ? GarmentType::trousers : GarmentType::shorts;
}

// A front is open where one opening runs from the neck to the hem; a blouse's edges meet, a jacket's stand apart. A coat's skirts reach further
// below the arms than it is wide.
GarmentType type_with_open_front(Piece& piece, const Opening& front)
{
    if (!piece.above(length_in_girths(piece.sleeves), k_armhole_length))
        return GarmentType::vest;
    const Opening &a = piece.sleeves[0], &b = piece.sleeves[1];
    const double chest = (a.tube_end - b.tube_end).norm(),
                 skirts = 0.5 * (a.tube_end.y() + b.tube_end.y()) - a.piece_low;
    if (piece.above(skirts / chest, 1.5))
        return GarmentType::coat;
    return piece.above(std::hypot(front.facing.x(), front.facing.z()), 0.3) ? GarmentType::jacket : GarmentType::blouse;
}

// Armholes are wide and face up or sideways; sleeves are narrower and face sideways or down.
double armhole_likeness(const std::vector<Opening>& pair, const Opening& hem)
{
    const double width = std::min(pair[0].tube_waist, pair[1].tube_waist) / hem.tube_waist;
    return width + 0.15 * (pair[0].facing.y() + pair[1].facing.y());
}

GarmentType type_with_hem(Piece& piece, const Opening& hem, const Opening& top)
{
    if (piece.above(piece.height / hem.tube_waist, 1.1))
        return GarmentType::dress;
    if (piece.sleeves.empty() || piece.above(armhole_likeness(piece.sleeves, hem), k_armhole))
        return GarmentType::vest;
    if (!piece.above(length_in_girths(piece.sleeves), k_long_sleeve))
        return GarmentType::tshirt;
    return top.facing.y() < 0.5 ? GarmentType::hoodie : GarmentType::longsleeve;
}

std::optional<GarmentType> type_of(Piece& piece)
{
    if (!piece.legs.empty())
        return type_with_legs(piece);
    if (piece.others.size() < (piece.sleeves.empty() ? 2 : 1))  // a way in, but none out
        return {};
    const Opening& lowest = piece.others.front();
    const Opening& highest = piece.others.back();
    const bool open_front = lowest.high.y() - lowest.low.y() > 0.6 * piece.height;
    if (open_front)
        return piece.sleeves.empty() ? GarmentType::vest : type_with_open_front(piece, lowest);
    if (piece.sleeves.empty() && piece.others.size() == 2)
        return GarmentType::skirt;
    if (piece.others.size() < 2)
        return {};
    return type_with_hem(piece, lowest, highest);
}

bool are_armholes(const Piece& piece)
{
    const double length = length_in_girths(piece.sleeves);
    return length < k_armhole_length
        || (length < k_long_sleeve && piece.legs.empty() && piece.others.size() > 1
            && armhole_likeness(piece.sleeves, piece.others.front()) > k_armhole);
}

enum class Sleeves { none, upper_arm, whole_arm };

Sleeves sleeves_of(const Piece& piece)
{
    if (piece.sleeves.empty() || are_armholes(piece))
        return Sleeves::none;
    return length_in_girths(piece.sleeves) > k_long_sleeve ? Sleeves::whole_arm : Sleeves::upper_arm;
}

// m, of its openings, from front to back as its legs or sleeves tell.
double depth_of(const Piece& piece)
{
    const std::vector<Opening>& pair = piece.legs.empty() ? piece.sleeves : piece.legs;
    const Vec3 across = pair[1].centre - pair[0].centre;
    const Vec3 forwards = across.cross(Vec3::UnitY()).normalized();
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const auto* some : { &piece.legs, &piece.sleeves, &piece.others })
        for (const Opening& opening : *some) {
            low = std::min(low, (opening.rim * forwards).minCoeff());
            high = std::max(high, (opening.rim * forwards).maxCoeff());
        }
    return high - low;
}

// Legs point down, and so do sleeves; where they are held level, they leave from the upper half, above a hem or under a neckline. Who
// lies is deeper than high. A waist is narrower than a hem.
double uprightness(const Piece& piece)
{
    constexpr double level = 0.25, plumb = 0.6;  // sines
    constexpr double least_narrower = 0.05, clearly_narrower = 0.3;  // shares of the hem's girth
    if (!piece.legs.empty())
        return piece.height > depth_of(piece) ? 1 : 0;
    const auto is_plumb = [](const Opening& opening) { return std::abs(opening.facing.y()) > plumb; };
    if (!std::any_of(piece.others.begin(), piece.others.end(), is_plumb))
        return 0;
    if (piece.sleeves.empty()) {
        const double narrower = piece.others.size() == 2 ? 1 - piece.others[1].girth / piece.others[0].girth : 0;
        return narrower > least_narrower ? std::min(1.0, narrower / clearly_narrower) : 0;
    }
    const double facing = sleeves_of(piece) == Sleeves::none  // armholes face any way
        ? 0
        : 0.5 * (piece.sleeves[0].facing.y() + piece.sleeves[1].facing.y());
    const double height = 0.5 * (piece.sleeves[0].centre.y() + piece.sleeves[1].centre.y());
    const bool points_down = facing < -level || (facing < level && height > piece.middle);
    return points_down && piece.height > depth_of(piece) ? 1 : 0;
}

// Where elbows bend; across, two sleeves need not be alike.
Vec3 bend_of(const std::vector<Opening>& sleeves)
{
    const Vec3 across = (sleeves[1].centre - sleeves[0].centre).stableNormalized();
    Vec3 bend = sleeves[0].facing + sleeves[1].facing;
    bend -= bend.dot(across) * across;
    bend.y() = 0;
    return bend;
}

// Necklines are lower in front, trousers rise higher behind, coats open in front, elbows bend forwards: openings face the front. A hem faces
// down, and the one opening above a bib, round straps, faces anywhere.
Vec3 front_of(const Piece& piece)
{
    const auto share_of_height
        = [](const Opening& opening) { return (opening.high.y() - opening.low.y()) / opening.piece_height; };
    Vec3 sum = Vec3::Zero();
    for (const Opening& leg : piece.legs)
        sum += leg.facing;
    if (!piece.sleeves.empty())
        sum += bend_of(piece.sleeves);
    for (const Opening& opening : piece.others) {
        const bool is_hem = opening.facing.y() < -0.8 && share_of_height(opening) < 0.5;
        if (!is_hem && (piece.legs.empty() || share_of_height(opening) < 0.25))
            sum += opening.facing;
    }
    return sum - sum.y() * Vec3::UnitY();
}

bool is_for_legs(GarmentType type)
{
    return type == GarmentType::trousers || type == GarmentType::shorts || type == GarmentType::skirt
        || type == GarmentType::jumpsuit;
}

}  // namespace

TypeGuess guess_type(const std::vector<Opening>& openings)
{
    TypeGuess guess;
    bool legs = false, tops = false;
    double largest = 0;
    for (Piece& piece : pieces_of(openings)) {
        const auto type = type_of(piece);
        if (!type)
            continue;
        (is_for_legs(*type) ? legs : tops) = true;
        if (piece.height > largest)
            guess = { *type, std::min(1.0, piece.margin) };
        largest = std::max(largest, piece.height);
    }
    if (legs && tops)
        guess.type = GarmentType::suit;
    return guess;
}

TypeGuess guess_garment_type(const GarmentMesh& garment) { return guess_type(openings_of(outward_cloth(garment))); }

double uprightness(const std::vector<Opening>& openings)
{
    double result = 0, height = 0;
    for (const Piece& piece : pieces_of(openings)) {
        result += piece.height * uprightness(piece);
        height += piece.height;
    }
    return height > 0 ? result / height : 0;
}

TypeGuess resolve_type(GarmentType given, const std::vector<Opening>& openings)
{
    if (given != GarmentType::automatic)
        return { given, 1 };
    const TypeGuess guess = guess_type(openings);
    if (guess.type == GarmentType::automatic)
        throw InvalidInput(std::string("garment has ") + (openings.size() == 1 ? "only one opening" : "no openings")
                           + " that a body could be put through, so its type cannot be told; give a garment with a way "
                             "in and a way out, or its type");
    return guess;
}

const std::vector<std::string_view>& garment_type_names()
{
    static const std::vector<std::string_view> names { "auto",   "tshirt", "longsleeve", "blouse",   "hoodie",
                                                       "jacket", "coat",   "vest",       "trousers", "shorts",
                                                       "skirt",  "dress",  "jumpsuit",   "suit" };
    return names;
}

GarmentType garment_type_of(std::string_view name)
{
    const auto& names = garment_type_names();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found != names.end())
        return GarmentType(found - names.begin());
    std::string known;
    for (const auto& n : names)
        known += (known.empty() ? "" : ", ") + std::string(n);
    throw InvalidInput("garment type \"" + std::string(name) + "\" is unknown; give one of " + known);
}

std::string_view name_of(GarmentType type) { return garment_type_names()[int(type)]; }

std::vector<Bone> bones_covered_by(GarmentType type)
{
    switch (type) {
    case GarmentType::automatic: return {};
    case GarmentType::tshirt: return together({ k_trunk, k_upper_arms });
    case GarmentType::longsleeve:
    case GarmentType::blouse:
    case GarmentType::hoodie:
    case GarmentType::jacket: return together({ k_trunk, k_upper_arms, k_forearms });
    case GarmentType::coat: return together({ k_trunk, k_upper_arms, k_forearms, k_thighs });
    case GarmentType::vest: return together({ k_trunk });
    case GarmentType::trousers: return together({ k_thighs, k_shins });
    case GarmentType::shorts:
    case GarmentType::skirt: return together({ k_thighs });
    case GarmentType::dress: return together({ k_trunk, k_upper_arms, k_thighs });
    case GarmentType::jumpsuit:
    case GarmentType::suit: return together({ k_trunk, k_upper_arms, k_forearms, k_thighs, k_shins });
    }
    return {};
}

std::vector<Bone> bones_covered_by(GarmentType type, const std::vector<Opening>& openings)
{
    std::vector<Bone> bones = bones_covered_by(type);
    const bool any_sleeves = type == GarmentType::dress || type == GarmentType::jumpsuit || type == GarmentType::suit;
    if (!any_sleeves || openings.empty())
        return bones;
    Sleeves longest = Sleeves::none;
    for (const Piece& piece : pieces_of(openings))
        longest = std::max(longest, sleeves_of(piece));
    const auto is_bare = [&](Bone b) {
        const bool upper = b == lhumerus || b == rhumerus, fore = b == lradius || b == rradius;
        return (upper && longest == Sleeves::none) || (fore && longest != Sleeves::whole_arm);
    };
    bones.erase(std::remove_if(bones.begin(), bones.end(), is_bare), bones.end());
    return bones;
}

GarmentCues cues_of(const std::vector<Opening>& openings)
{
    GarmentCues cues;
    double longest = 0, tallest = 0;
    for (const Piece& piece : pieces_of(openings)) {
        cues.front += front_of(piece);
        if (!piece.legs.empty())
            cues.hems = { piece.legs[0].centre, piece.legs[1].centre };
        const auto& pair = piece.legs.empty() ? piece.sleeves : piece.legs;
        if (!pair.empty() && piece.height > tallest) {
            tallest = piece.height;
            cues.across = pair[1].centre - pair[0].centre;
            cues.across.y() = 0;
        }
        if (sleeves_of(piece) != Sleeves::none && length_of(piece.sleeves) > longest) {
            longest = length_of(piece.sleeves);
            cues.cuffs = { piece.sleeves[0].centre, piece.sleeves[1].centre };
        }
    }
    return cues;
}

}  // namespace garmentfit
