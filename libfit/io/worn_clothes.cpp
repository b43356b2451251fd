// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/worn_clothes.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numeric>

#include "garmentfit/error.h"
#include "garmentfit/skinned_gltf.h"
#include "mesh_content.h"
#include "tuning.h"
#include "winding_number.h"

namespace garmentfit {
namespace {

/// Anywhere in a name: "male_casualsuit01".
constexpr std::array<std::string_view, 27> k_clothes {
    "outfit",    "cloth",   "shirt",  "trouser", "pants",    "jeans",    "skirt",    "dress",    "jacket",
    "sweater",   "hoodie",  "blouse", "suit",    "footwear", "sneaker",  "uniform",  "onepiece", "garment",
    "underwear", "apparel", "kimono", "legging", "cardigan", "stocking", "headwear", "glove",    "pullover"
};
/// Whole words of a name, as "cap" in "HatAndCap": they are parts of other words.
constexpr std::array<std::string_view, 23> k_clothes_words { "top",  "tops",   "bottom", "bottoms", "bra",  "hat",
                                                             "cap",  "tie",    "belt",   "scarf",   "tee",  "coat",
                                                             "vest", "shorts", "sock",   "socks",   "shoe", "shoes",
                                                             "boot", "boots",  "heels",  "sandals", "robe" };
/// Parts that are never clothes, in the same two ways.
constexpr std::array<std::string_view, 5> k_body { "skin", "hair", "eye", "teeth", "tongue" };
constexpr std::array<std::string_view, 6> k_body_words { "body", "face", "head", "hands", "beard", "nails" };

/// "N00_007_01_Tops_01" -> n, tops; "LeftShoe" -> left, shoe.
std::vector<std::string> words_of(const std::string& name)
{
    std::vector<std::string> words(1);
    bool was_lower = false;
    for (const char character : name) {
        const auto c = static_cast<unsigned char>(character);
        if (!std::isalpha(c) || (std::isupper(c) && was_lower))
            words.emplace_back();
        if (std::isalpha(c))
            words.back() += char(std::tolower(c));
        was_lower = std::islower(c) != 0;
    }
    return words;
}

enum class Meaning { nothing, body, clothes };

Meaning meaning_of(const std::string& name)
{
    std::string lower = name;
    std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    const std::vector<std::string> words = words_of(name);
    const auto has = [&](const auto& parts) {
        return std::any_of(parts.begin(), parts.end(),
                           [&](std::string_view part) { return lower.find(part) != std::string::npos; });
    };
    const auto has_word = [&](const auto& known) {
        return std::any_of(known.begin(), known.end(), [&](std::string_view word) {
            return std::find(words.begin(), words.end(), word) != words.end();
        });
    };
    if (has(k_body))
        return Meaning::body;
    if (has(k_clothes) || has_word(k_clothes_words))
        return Meaning::clothes;
    return has_word(k_body_words) ? Meaning::body : Meaning::nothing;
}

/// The first name that says something, the narrowest first.
bool is_clothes(const MeshPart& part)
{
    for (const std::string* name : { &part.material, &part.mesh, &part.node })
        if (const Meaning meaning = meaning_of(*name); meaning != Meaning::nothing)
            return meaning == Meaning::clothes;
    return false;
}

const std::string& name_of(const MeshPart& part)
{
    for (const std::string* name : { &part.material, &part.mesh, &part.node })
        if (meaning_of(*name) == Meaning::clothes)
            return *name;
    return part.material;
}

/// A bone, or what is beyond the last bone of a limb, that a part hangs on.
struct Stretch {
    std::string name;
    Vec3 begin, end;
};

class SkinUnderClothes {
public:
    SkinUnderClothes(const TriangleMesh& skin, const TriangleMesh& all, const ForeignRig& rig) :
        inside_skin_(skin), all_(all), rig_(rig)
    {
    }

    /// Where the part hangs, and no skin is. Empty where it can be left out.
    std::vector<std::string> missing_under(const std::vector<int>& triangles) const
    {
        std::vector<std::string> missing;
        for (const Stretch& stretch : stretches_of(triangles))
            if (share_inside(stretch) < k_least_skin)
                missing.push_back(stretch.name);
        return missing;
    }

private:
    double share_inside(const Stretch& stretch) const
    {
        int inside = 0;
        for (int i = 0; i < k_skin_samples; ++i) {
            const double t = (i + 0.5) / k_skin_samples;
            inside += std::abs(inside_skin_(stretch.begin + t * (stretch.end - stretch.begin))) > 0.5;
        }
        return double(inside) / k_skin_samples;
    }

    std::vector<Stretch> stretches_of(const std::vector<int>& triangles) const
    {
        std::array<double, bone_count> on {}, beyond {};  // weights
        double all = 0;
        for (const int f : triangles)
            for (int corner = 0; corner < 3; ++corner)
                for (int k = 0; k < 4; ++k) {
                    const int v = all_.triangles(f, corner), bone = rig_.weights.bones(v, k);
                    const double weight = rig_.weights.weights(v, k);
                    (is_beyond(bone, all_.positions.row(v)) ? beyond : on)[std::size_t(bone)] += weight;
                    all += weight;
                }
        std::vector<Stretch> stretches;
        const Skeleton& skeleton = rig_.skeleton;
        for (int bone = 0; bone < bone_count; ++bone)
            if (on[std::size_t(bone)] > k_least_hold * all)
                stretches.push_back({ std::string(bone_name(bone)), skeleton.head(bone), skeleton.tail(bone) });
        for (int e = 0; e < extremity_count; ++e)
            if (const int bone = bone_before(Extremity(e)); beyond[std::size_t(bone)] > k_least_hold * all)
                stretches.push_back({ std::string(bone_name(bone)) + "'s end", skeleton.tail(bone),
                                      0.5 * (skeleton.tail(bone) + skeleton.tips[std::size_t(e)]) });
        return stretches;
    }

    /// Skin of hands and feet follows the bone before them.
    bool is_beyond(int bone, const Vec3& place) const
    {
        for (int e = 0; e < extremity_count; ++e)
            if (bone_before(Extremity(e)) == bone)
                return (place - rig_.skeleton.tail(bone)).dot(rig_.skeleton.direction(bone)) > 0;
        return false;
    }

    WindingNumber inside_skin_;
    const TriangleMesh& all_;
    const ForeignRig& rig_;
};

std::vector<int> rows_of(const MeshPart& part)
{
    std::vector<int> rows(std::size_t(part.triangles));
    std::iota(rows.begin(), rows.end(), int(part.first_triangle));
    return rows;
}

std::vector<int> rows_of(const std::vector<MeshPart>& parts, const std::vector<char>& is_left_out)
{
    std::vector<int> rows;
    for (std::size_t i = 0; i < parts.size(); ++i)
        if (!is_left_out[i])
            for (const int row : rows_of(parts[i]))
                rows.push_back(row);
    return rows;
}

std::string list_of(const std::vector<std::string>& names)
{
    std::string text;
    for (const std::string& name : names)
        text += (text.empty() ? "" : ", ") + name;
    return text;
}

StrippedBody whole(const MeshFile& avatar, const std::string& why)
{
    StrippedBody body;
    body.kept.resize(std::size_t(avatar.triangles().rows()));
    std::iota(body.kept.begin(), body.kept.end(), 0);
    body.warnings.push_back(why + "; all parts are the body");
    return body;
}

}  // namespace

const std::vector<std::string_view>& wears_names()
{
    static const std::vector<std::string_view> names { "keep", "strip" };
    return names;
}

Wears wears_called(std::string_view name)
{
    const std::vector<std::string_view>& names = wears_names();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
        throw InvalidInput(ErrorCode::unknown_name, "wears " + std::string(name) + ": give keep or strip");
    return Wears(found - names.begin());
}

StrippedBody strip_clothes(const MeshFile& avatar)
{
    const std::vector<MeshPart> parts = avatar.parts();
    std::vector<char> is_left_out;
    for (const MeshPart& part : parts)
        is_left_out.push_back(is_clothes(part));
    if (std::count(is_left_out.begin(), is_left_out.end(), 1) == 0)
        return whole(avatar, "no part of the file is named as clothes");
    const std::vector<int> skin_rows = rows_of(parts, is_left_out);
    if (skin_rows.empty())
        return whole(avatar, "all parts of the file are named as clothes, and none as skin");
    ForeignRig rig;
    try {
        rig = read_skinned_gltf(avatar.path());
    } catch (const InvalidInput& error) {
        return whole(avatar,
                     std::string("without the joints of a skin nothing tells where skin has to be (") + error.what()
                         + ")");
    }
    const TriangleMesh all { avatar.positions(), avatar.triangles() },
        skin { avatar.positions(), avatar.triangles()(skin_rows, Eigen::all) };
    const SkinUnderClothes under(skin, all, rig);
    StrippedBody body;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (!is_left_out[i])
            continue;
        const std::vector<std::string> missing = under.missing_under(rows_of(parts[i]));
        is_left_out[i] = missing.empty();
        if (missing.empty())
            body.stripped.push_back(name_of(parts[i]));
        else
            body.warnings.push_back(name_of(parts[i]) + " is not left out, as the file has no skin under it at "
                                    + list_of(missing) + "; it counts as part of the body");
    }
    body.kept = rows_of(parts, is_left_out);
    return body;
}

std::vector<std::string> notes_on(const StrippedBody& body)
{
    std::vector<std::string> notes = body.warnings;
    if (!body.stripped.empty())
        notes.push_back("left out of the body: " + list_of(body.stripped));
    return notes;
}

Triangles triangles_of(const MeshFile& avatar, const StrippedBody& body)
{
    return avatar.triangles()(body.kept, Eigen::all);
}

Appearance appearance_of(Appearance look, const StrippedBody& body)
{
    if (!look.material_of.empty()) {
        std::vector<int> materials;
        for (const int row : body.kept)
            materials.push_back(look.material_of[std::size_t(row)]);
        look.material_of = std::move(materials);
    }
    if (look.uv_corners.rows() > 0)
        look.uv_corners = Triangles(look.uv_corners(body.kept, Eigen::all));
    return look;
}

}  // namespace garmentfit
