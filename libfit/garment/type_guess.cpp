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
#include "tuning.h"

namespace garmentfit {
namespace {

using namespace garment_tuning;

const std::vector<Bone> k_waist { lowerback, upperback };
const std::vector<Bone> k_spine { lowerback, upperback, thorax };
const std::vector<Bone> k_trunk { lowerback, upperback, thorax, lclavicle, rclavicle };
const std::vector<Bone> k_upper_arms { lhumerus, rhumerus };
const std::vector<Bone> k_forearms { lradius, rradius };
const std::vector<Bone> k_thighs { lhipjoint, rhipjoint, lfemur, rfemur };
const std::vector<Bone> k_shins { ltibia, rtibia };

std::vector<Bone> unite(std::initializer_list<std::vector<Bone>> groups)
{
    std::vector<Bone> bones;
    for (const auto& group : groups)
        bones.insert(bones.end(), group.begin(), group.end());
    std::sort(bones.begin(), bones.end());
    return bones;
}

/// One connected piece of cloth with classified openings.
struct Piece {
    std::vector<Opening> sleeves, legs;  // two each, or empty
    std::vector<Opening> others;  // neck, hem, waist, an open front
    double height = 0;  // m
    double middle = 0;  // m, y that separates arms from legs
    double confidence = 1;  // smallest confidence of all decisions

    /// Whether `value` is above `threshold`; reduces the confidence if it is close.
    bool above(double value, double threshold)
    {
        confidence = std::min(confidence, k_confidence_slope * std::abs(value - threshold) / threshold);
        return value > threshold;
    }
};

Vec3 level(const Vec3& v) { return { v.x(), 0, v.z() }; }

Vec3 level_between(const Opening& a, const Opening& b)
{
    Vec3 across = b.centre - a.centre;
    across.y() = 0;
    return across;
}

bool is_long_tube(const Opening& opening) { return opening.tube_length > k_long_sleeve * opening.tube_girth; }

bool are_similar(double x, double y) { return std::max(x, y) < k_pair_girths * std::min(x, y); }

/// Whether two openings have equal girths, or end tubes that do: the edge of one cuff may be folded in, that of the other
/// not.
bool are_as_wide(const Opening& a, const Opening& b)
{
    return are_similar(a.girth, b.girth)
        || (is_long_tube(a) && is_long_tube(b) && are_similar(a.tube_girth, b.tube_girth)
            && are_similar(a.tube_waist, b.tube_waist) && are_similar(a.tube_length, b.tube_length));
}

/// Whether two openings are as wide and as high as each other, on two sides of the piece.
bool are_alike(const Opening& a, const Opening& b)
{
    return are_as_wide(a, b) && std::abs(b.centre.y() - a.centre.y()) < k_pair_lift * a.piece_height
        && level_between(a, b).norm() > k_pair_distance * std::max(a.girth, b.girth);
}

/// Whether two openings are mirror images.
bool are_pair(const Opening& a, const Opening& b)
{
    return are_alike(a, b) && face_alike(a, b, level_between(a, b).normalized());
}

std::vector<Opening> take_pair(std::vector<Opening>& from, std::size_t i, std::size_t j)
{
    const std::vector<Opening> pair { from[i], from[j] };
    from.erase(from.begin() + j);
    from.erase(from.begin() + i);
    return pair;
}

/// Legs are the lowest two openings. If a hem is as low or between them, they are sleeves.
void take_legs(Piece& piece)
{
    auto& all = piece.others;
    if (all.size() < 3 || !are_pair(all[0], all[1]) || all[0].facing.y() > k_leg_normal
        || all[1].facing.y() > k_leg_normal)
        return;
    for (std::size_t i = 2; i < all.size(); ++i)
        if (all[i].facing.y() < k_hem_between_legs || all[i].low.y() < std::max(all[0].high.y(), all[1].high.y()))
            return;
    if (all.back().facing.y() > k_waist_normal)  // otherwise a jacket that lies on its back
        piece.legs = take_pair(all, 0, 1);
}

/// Whether openings are narrow enough for arms, compared with the widest opening.
bool are_narrow(const Opening& a, const Opening& b, const Piece& piece)
{
    double widest = 0;
    for (const Opening& other : piece.others)
        if (&other != &a && &other != &b)
            widest = std::max(widest, other.girth);
    return !piece.legs.empty() || std::max(a.girth, b.girth) < k_narrow * widest;
}

/// Whether one opening is a sleeve, a tube, and the other an armhole across the chest, with a hem below.
bool are_sleeve_and_armhole(const Opening& sleeve, const Opening& armhole, const Piece& piece)
{
    const Vec3 across = (armhole.centre - sleeve.centre).normalized();
    const double facing = std::min(-sleeve.facing.dot(across), armhole.facing.dot(across));
    const bool is_missing = sleeve.girth < armhole.girth  // or cut short
        || (sleeve.girth < k_stub_girth * armhole.girth && sleeve.tube_length > k_stub_length * armhole.tube_length);
    const bool has_hem = std::any_of(piece.others.begin(), piece.others.end(), [&](const Opening& other) {
        return other.facing.y() < k_hem_below && other.low.y() < std::min(sleeve.low.y(), armhole.low.y());
    });
    return sleeve.tube_length > k_sleeve_tube * sleeve.tube_girth && is_missing && facing > k_sleeve_facing
        && std::abs(across.y()) < k_across_lift && armhole.centre.y() > piece.middle
        && (has_hem || !piece.legs.empty());
}

/// The missing sleeve has length 0.
std::vector<Opening> take_sleeve_and_armhole(std::vector<Opening>& from, std::size_t sleeve, std::size_t armhole)
{
    from[armhole].tube_length = 0;
    return take_pair(from, std::min(sleeve, armhole), std::max(sleeve, armhole));
}

bool face_apart(const Opening& a, const Opening& b)
{
    const Vec3 across = b.centre - a.centre;
    return a.facing.dot(across) < 0 && b.facing.dot(across) > 0;
}

/// Whether two openings lie beyond both sides of all others.
/// @param distance  between the two, in widths of the widest other one
bool are_beyond(const Opening& a, const Opening& b, const Piece& piece, double distance)
{
    const Vec3 across = level_between(a, b), axis = across.stableNormalized();
    return std::all_of(piece.others.begin(), piece.others.end(), [&](const Opening& other) {
        const Eigen::VectorXd along = other.rim * axis;
        return &other == &a || &other == &b || across.norm() > distance * (along.maxCoeff() - along.minCoeff());
    });
}

/// Whether two openings lie wholly beside all others, on both sides.
bool are_beside(const Opening& a, const Opening& b, const Piece& piece)
{
    const Vec3 axis = level_between(a, b).stableNormalized();
    const double low = (a.rim * axis).maxCoeff(), high = (b.rim * axis).minCoeff();
    return std::all_of(piece.others.begin(), piece.others.end(), [&](const Opening& other) {
        const Eigen::VectorXd along = other.rim * axis;
        return &other == &a || &other == &b || (along.minCoeff() > low && along.maxCoeff() < high);
    });
}

bool is_sleeve(const Opening& opening) { return opening.tube_length > k_armhole_length * opening.tube_girth; }

/// Sleeves that hang may face anywhere; long ones come down beside the hem, and may be fused with the trunk above it.
bool are_hanging_sleeves(const Opening& a, const Opening& b, const Piece& piece)
{
    return are_alike(a, b)
        && (are_beyond(a, b, piece, is_long_tube(a) && is_long_tube(b) ? 1 : k_arms_beyond)
            || (piece.others.size() >= 4 && is_sleeve(a) && is_sleeve(b) && are_beside(a, b, piece)));
}

bool are_sleeves(const Opening& a, const Opening& b, const Piece& piece)
{
    return are_narrow(a, b, piece) && ((are_pair(a, b) && face_apart(a, b)) || are_hanging_sleeves(a, b, piece));
}

/// Whether two openings end long tubes that are alike and lead to two places apart, wherever they end: arms of somebody
/// who stands in a pose. Neck and hem are two more openings, or one with an open front; trousers with one leg lifted have
/// a waist only.
bool are_posed_sleeves(const Opening& a, const Opening& b, const Piece& piece)
{
    Vec3 apart = b.tube_end - a.tube_end;
    apart.y() = 0;
    const auto is_tall = [&](const Opening& opening) {
        return &opening != &a && &opening != &b && opening.high.y() - opening.low.y() > k_open_front * piece.height;
    };
    const bool has_neck_and_hem
        = piece.others.size() >= 4 || std::any_of(piece.others.begin(), piece.others.end(), is_tall);
    return has_neck_and_hem && is_long_tube(a) && is_long_tube(b) && are_as_wide(a, b)
        && are_similar(a.tube_length, b.tube_length) && are_narrow(a, b, piece)
        && std::min(a.tube_end.y(), b.tube_end.y()) > piece.middle
        && apart.norm() > k_shoulders_apart * std::max(a.tube_girth, b.tube_girth);
}

/// Of pairs that may be sleeves, those with the longest tubes: slits in them are pairs, too.
void take_sleeves(Piece& piece)
{
    auto& all = piece.others;
    std::optional<std::pair<std::size_t, std::size_t>> longest;
    double length = 0;
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t j = i + 1; j < all.size(); ++j)
            if (const double shorter = std::min(all[i].tube_length, all[j].tube_length);
                are_sleeves(all[i], all[j], piece) && (!longest || shorter > length)) {
                longest = { i, j };
                length = shorter;
            }
    for (std::size_t i = 0; i < all.size() && !longest; ++i)
        for (std::size_t j = i + 1; j < all.size() && !longest; ++j)
            if (are_posed_sleeves(all[i], all[j], piece))
                longest = { i, j };
    if (longest)
        piece.sleeves = take_pair(all, longest->first, longest->second);
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
        piece.middle = some[0].piece_low + k_arm_height * piece.height;
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

/// m, of the longer one.
double length_of(const std::vector<Opening>& pair) { return std::max(pair[0].tube_length, pair[1].tube_length); }

GarmentType type_with_legs(Piece& piece)
{
    if (!piece.sleeves.empty() || piece.above(piece.height / length_of(piece.legs), k_jumpsuit_height))
        return GarmentType::jumpsuit;
    return piece.above(length_in_girths(piece.legs), k_trouser_length) ? GarmentType::trousers : GarmentType::shorts;
}

/// An open front is one opening from neck to hem. The edges of a blouse meet, those of a jacket are apart. A coat's
/// skirts are longer below the arms than the coat is wide.
GarmentType type_with_open_front(Piece& piece, const Opening& front)
{
    if (!piece.above(length_in_girths(piece.sleeves), k_armhole_length))
        return GarmentType::vest;
    const Opening &a = piece.sleeves[0], &b = piece.sleeves[1];
    const double chest = (a.tube_end - b.tube_end).norm(),
                 skirts = 0.5 * (a.tube_end.y() + b.tube_end.y()) - a.piece_low;
    if (piece.above(skirts / chest, k_coat_skirts))
        return GarmentType::coat;
    return piece.above(std::hypot(front.facing.x(), front.facing.z()), k_jacket_front) ? GarmentType::jacket
                                                                                       : GarmentType::blouse;
}

/// Armholes are wide and face up or sideways. Sleeves are narrower and face sideways or down.
double armhole_likeness(const std::vector<Opening>& pair, const Opening& hem)
{
    const double width = std::min(pair[0].tube_waist, pair[1].tube_waist) / hem.tube_waist;
    return width + k_armhole_normal * (pair[0].facing.y() + pair[1].facing.y());
}

GarmentType type_with_hem(Piece& piece, const Opening& hem, const Opening& top)
{
    if (piece.above(piece.height / hem.tube_waist, k_dress_height))
        return GarmentType::dress;
    if (piece.sleeves.empty() || piece.above(armhole_likeness(piece.sleeves, hem), k_armhole))
        return GarmentType::vest;
    if (!piece.above(length_in_girths(piece.sleeves), k_long_sleeve))
        return GarmentType::tshirt;
    return top.facing.y() < k_hood_normal ? GarmentType::hoodie : GarmentType::longsleeve;
}

/// From neck to hem, which are one opening. @pre it has openings beside sleeves and legs
bool is_open_in_front(const Piece& piece)
{
    const Opening& lowest = piece.others.front();
    return lowest.high.y() - lowest.low.y() > k_open_front * piece.height;
}

std::optional<GarmentType> type_of(Piece& piece)
{
    if (!piece.legs.empty())
        return type_with_legs(piece);
    if (piece.others.size() < (piece.sleeves.empty() ? 2 : 1))  // too few openings for a body
        return {};
    const Opening& lowest = piece.others.front();
    const Opening& highest = piece.others.back();
    if (is_open_in_front(piece))
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

/// Extent of the openings from front to back, m; legs or sleeves determine the direction.
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

/// Evidence for upright: legs and sleeves point down. Horizontal sleeves are in the upper half. A piece that lies is
/// deeper than high. A waist is narrower than a hem.
double uprightness(const Piece& piece)
{
    if (!piece.legs.empty())
        return piece.height > depth_of(piece) ? 1 : 0;
    const auto is_vertical = [](const Opening& opening) { return std::abs(opening.facing.y()) > k_plumb; };
    if (!std::any_of(piece.others.begin(), piece.others.end(), is_vertical))
        return 0;
    if (piece.sleeves.empty()) {
        const double narrower = piece.others.size() == 2 ? 1 - piece.others[1].girth / piece.others[0].girth : 0;
        return narrower > k_least_narrower ? std::min(1.0, narrower / k_clearly_narrower) : 0;
    }
    const double facing = sleeves_of(piece) == Sleeves::none  // armholes face any way
        ? 0
        : 0.5 * (piece.sleeves[0].facing.y() + piece.sleeves[1].facing.y());
    const double height = 0.5 * (piece.sleeves[0].centre.y() + piece.sleeves[1].centre.y());
    const bool points_down = facing < -k_level || (facing < k_level && height > piece.middle);
    return points_down && piece.height > depth_of(piece) ? 1 : 0;
}

/// A top and a hem, or legs, and nothing else: no opening for an arm, and no strap.
bool is_strapless(const Piece& piece)
{
    return piece.sleeves.empty() && piece.others.size() == (piece.legs.empty() ? 2 : 1);
}

/// From one leg to the other, or from one sleeve to the other, level. Hands may be anywhere: between the shoulders, where
/// the sleeves are long enough to tell them.
Vec3 across_of(const Piece& piece)
{
    const std::vector<Opening>& pair = piece.legs.empty() ? piece.sleeves : piece.legs;
    const bool are_long_sleeves = piece.legs.empty() && is_long_tube(pair[0]) && is_long_tube(pair[1]);
    Vec3 across = are_long_sleeves ? Vec3(pair[1].tube_end - pair[0].tube_end) : Vec3(pair[1].centre - pair[0].centre);
    across.y() = 0;
    return across;
}

/// Direction in which elbows bend: sum of the sleeves' normals, horizontal, without the part across.
Vec3 bend_of(const std::vector<Opening>& sleeves)
{
    const Vec3 across = (sleeves[1].centre - sleeves[0].centre).stableNormalized();
    Vec3 bend = sleeves[0].facing + sleeves[1].facing;
    bend -= bend.dot(across) * across;
    bend.y() = 0;
    return bend;
}

/// Openings face the front: necklines are lower in front, trousers are higher behind, coats open in front, elbows bend
/// forwards. Left out are hems, which face down, and the opening above a bib with straps, which faces anywhere.
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
        const bool is_hem = opening.facing.y() < k_hem_normal && share_of_height(opening) < k_hem_share;
        if (!is_hem && (piece.legs.empty() || share_of_height(opening) < k_level_share))
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
            guess = { *type, std::min(1.0, piece.confidence) };
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

const std::vector<std::string_view>& garment_type_names()
{
    static const std::vector<std::string_view> names {
        "auto",     "tshirt",   "longsleeve", "blouse",   "hoodie", "jacket",   "coat",     "vest",      "trousers",
        "shorts",   "skirt",    "dress",      "jumpsuit", "suit",   "tanktop",  "camisole", "strapless", "halter",
        "leggings", "hotpants", "poncho",     "cape",     "robe",   "overalls", "top",      "bottom",    "whole"
    };
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
    throw InvalidInput(ErrorCode::unknown_name,
                       "garment type \"" + std::string(name) + "\" is unknown; give one of " + known);
}

bool is_coarse(GarmentType type)
{
    return type == GarmentType::top || type == GarmentType::bottom || type == GarmentType::whole;
}

std::string_view name_of(GarmentType type) { return garment_type_names()[int(type)]; }

std::vector<Bone> bones_covered_by(GarmentType type)
{
    switch (type) {
    case GarmentType::automatic:
    case GarmentType::top:
    case GarmentType::bottom:
    case GarmentType::whole: return {};
    case GarmentType::poncho:
    case GarmentType::cape:
    case GarmentType::tshirt: return unite({ k_trunk, k_upper_arms });
    case GarmentType::longsleeve:
    case GarmentType::blouse:
    case GarmentType::hoodie:
    case GarmentType::jacket: return unite({ k_trunk, k_upper_arms, k_forearms });
    case GarmentType::robe:
    case GarmentType::coat: return unite({ k_trunk, k_upper_arms, k_forearms, k_thighs });
    case GarmentType::tanktop:
    case GarmentType::camisole:
    case GarmentType::vest: return unite({ k_trunk });
    case GarmentType::strapless:
    case GarmentType::halter: return k_spine;
    case GarmentType::leggings:
    case GarmentType::trousers: return unite({ k_thighs, k_shins });
    case GarmentType::hotpants:
    case GarmentType::shorts:
    case GarmentType::skirt: return unite({ k_thighs });
    case GarmentType::overalls: return unite({ k_waist, k_thighs, k_shins });
    case GarmentType::dress: return unite({ k_trunk, k_upper_arms, k_thighs });
    case GarmentType::jumpsuit:
    case GarmentType::suit: return unite({ k_trunk, k_upper_arms, k_forearms, k_thighs, k_shins });
    }
    return {};
}

std::vector<Bone> bones_covered_by(GarmentType type, const std::vector<Opening>& openings)
{
    std::vector<Bone> bones = bones_covered_by(type);
    const bool any_sleeves = type == GarmentType::dress || type == GarmentType::jumpsuit || type == GarmentType::suit;
    if (openings.empty())
        return bones;
    Sleeves longest = Sleeves::none;
    bool are_short = false, are_strapless = type == GarmentType::dress || type == GarmentType::jumpsuit;
    for (const Piece& piece : pieces_of(openings)) {
        are_strapless &= is_strapless(piece);
        longest = std::max(longest, sleeves_of(piece));
        are_short |= !piece.sleeves.empty() && length_in_girths(piece.sleeves) < k_short_sleeve;
    }
    const auto is_uncovered = [&](Bone b) {
        const bool upper = b == lhumerus || b == rhumerus, fore = b == lradius || b == rradius;
        if (are_strapless && (b == lclavicle || b == rclavicle))
            return true;
        return any_sleeves ? (upper && longest == Sleeves::none) || (fore && longest != Sleeves::whole_arm)
                           : fore && are_short && longest != Sleeves::whole_arm;
    };
    bones.erase(std::remove_if(bones.begin(), bones.end(), is_uncovered), bones.end());
    return bones;
}

std::vector<Opening> openings_at_shoulders(const std::vector<Opening>& openings)
{
    std::vector<Opening> found;
    double tallest = 0;
    for (const Piece& piece : pieces_of(openings)) {
        const bool has_trunk = piece.others.size() > (piece.legs.empty() ? 1 : 0);
        if (piece.height <= tallest || piece.sleeves.empty() || !has_trunk || !are_armholes(piece)
            || is_open_in_front(piece))
            continue;
        tallest = piece.height;
        found = { piece.sleeves[0], piece.sleeves[1], piece.others.back() };
    }
    return found;
}

GarmentMeasures measures_of(const std::vector<Opening>& openings)
{
    GarmentMeasures measures;
    double tallest = 0;
    for (const Piece& piece : pieces_of(openings)) {
        if (piece.height <= tallest || piece.others.empty())
            continue;
        tallest = piece.height;
        measures = {};
        measures.piece = piece.others.front().piece;
        if (!piece.sleeves.empty()) {
            measures.shoulders = level_between(piece.sleeves[0], piece.sleeves[1]).norm();
            if (!are_armholes(piece)) {
                Vec3 across = piece.sleeves[1].tube_end - piece.sleeves[0].tube_end;
                across.y() = 0;
                measures.shoulders = across.norm();
                measures.sleeve = std::max(piece.sleeves[0].tube_girth, piece.sleeves[1].tube_girth);
                measures.sleeve_length = std::min(piece.sleeves[0].tube_length, piece.sleeves[1].tube_length);
            }
            measures.neck = piece.others.back().girth;
        }
        if (!piece.legs.empty()) {
            measures.leg = std::max(piece.legs[0].tube_girth, piece.legs[1].tube_girth);
            measures.inseam = length_of(piece.legs);
        }
        measures.trunk = piece.legs.empty() ? piece.others.front().tube_waist : piece.others.back().tube_waist;
    }
    return measures;
}

// The strap lies between two openings without a tube, which reach up to it, one on each side. The larger one is broad from
// arm to arm, where that of one bare shoulder is deep.
std::optional<Halter> find_halter(const std::vector<Opening>& openings)
{
    double top = -std::numeric_limits<double>::infinity();
    for (const Opening& opening : openings)
        top = std::max(top, opening.high.y());
    std::vector<const Opening*> high;
    for (const Opening& opening : openings)
        if (opening.high.y() > top - k_neck_strap && opening.tube_length < k_neck_strap)
            high.push_back(&opening);
    if (high.size() != 2)
        return {};
    if (high[0]->girth > high[1]->girth)
        std::swap(high[0], high[1]);
    const Opening &neck = *high[0], &back = *high[1];
    const Vec3 behind = level(back.facing).stableNormalized();
    const auto extent_along = [&](const Vec3& direction) {
        const Eigen::VectorXd along = back.rim * direction;
        return along.maxCoeff() - along.minCoeff();
    };
    const bool has_both_arms = extent_along(Vec3::UnitY().cross(behind)) > extent_along(behind);
    const bool is_behind = std::abs(back.facing.y()) < k_back_facing && neck.facing.dot(behind) < 0;
    return is_behind && has_both_arms ? std::optional(Halter { neck, back }) : std::nullopt;
}

GarmentCues cues_of(const std::vector<Opening>& openings, const std::optional<Vec3>& front)
{
    GarmentCues cues;
    if (front)
        cues.front_given = Vec3(front->x(), 0, front->z()).normalized();
    if (const std::vector<Opening> shoulders = openings_at_shoulders(openings); !shoulders.empty())
        cues.armholes = { shoulders[0].centre, shoulders[1].centre };
    double longest = 0, tallest = 0;
    cues.is_strapless = !openings.empty();
    for (const Piece& piece : pieces_of(openings)) {
        cues.front += front_of(piece);
        cues.is_strapless &= is_strapless(piece);
        cues.has_arms |= !piece.sleeves.empty();
        if (!piece.legs.empty())
            cues.hems = { piece.legs[0].centre, piece.legs[1].centre };
        const auto& pair = piece.legs.empty() ? piece.sleeves : piece.legs;
        if (!pair.empty() && piece.height > tallest) {
            tallest = piece.height;
            cues.across = across_of(piece);
        }
        if (sleeves_of(piece) != Sleeves::none && length_of(piece.sleeves) > longest) {
            longest = length_of(piece.sleeves);
            cues.cuffs = { piece.sleeves[0].centre, piece.sleeves[1].centre };
        }
    }
    if (const std::optional<Halter> halter = find_halter(openings)) {
        cues.is_halter = true;
        cues.front = -level(halter->back.facing).stableNormalized();
    }
    return cues;
}

}  // namespace garmentfit
