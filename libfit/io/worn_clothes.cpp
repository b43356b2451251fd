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
#include "scenery.h"
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

constexpr std::size_t k_most_names = 5;  // unit: of a list for the user

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

const std::string& name_of_clothes(const MeshPart& part)
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

/// Rows of triangles without those of some parts; parts may be none, in a format without names.
std::vector<int> rows_without(const MeshFile& avatar, const std::vector<MeshPart>& parts,
                              const std::vector<char>& is_left_out)
{
    std::vector<char> is_kept(std::size_t(avatar.triangles().rows()), 1);
    for (std::size_t i = 0; i < parts.size(); ++i)
        if (is_left_out[i])
            for (const int row : rows_of(parts[i]))
                is_kept[std::size_t(row)] = 0;
    std::vector<int> rows;
    for (std::size_t row = 0; row < is_kept.size(); ++row)
        if (is_kept[row])
            rows.push_back(int(row));
    return rows;
}

std::string list_of(const std::vector<std::string>& names)
{
    std::string text;
    for (const std::string& name : names)
        text += (text.empty() ? "" : ", ") + name;
    return text;
}

/// Leaves out clothes.
class Stripping {
public:
    /// @param parts, is_scenery  kept as references
    Stripping(const MeshFile& avatar, const std::vector<MeshPart>& parts, const std::vector<char>& is_scenery) :
        avatar_(avatar), parts_(parts), is_scenery_(is_scenery), is_left_out_(is_scenery)
    {
    }

    StrippedBody strip()
    {
        for (std::size_t i = 0; i < parts_.size(); ++i)
            is_left_out_[i] = is_scenery_[i] || is_clothes(parts_[i]);
        const std::vector<int> skin_rows = rows_without(avatar_, parts_, is_left_out_);
        if (is_left_out_ == is_scenery_)
            return keep_all("no part of the file is named as clothes");
        if (skin_rows.empty())
            return keep_all("all parts of the file are named as clothes, and none as skin");
        try {
            return strip_above(skin_rows, read_skinned_gltf(avatar_.path()));
        } catch (const InvalidInput& error) {
            return keep_all(std::string("without the joints of a skin nothing tells where skin has to be (")
                            + error.what() + ")");
        }
    }

private:
    StrippedBody keep_all(const std::string& why) const
    {
        StrippedBody body;
        body.kept = rows_without(avatar_, parts_, is_scenery_);
        body.warnings.push_back(why + "; all parts are the body");
        return body;
    }

    StrippedBody strip_above(const std::vector<int>& skin_rows, const ForeignRig& rig)
    {
        const TriangleMesh all { avatar_.positions(), avatar_.triangles() },
            skin { avatar_.positions(), avatar_.triangles()(skin_rows, Eigen::all) };
        const SkinUnderClothes under(skin, all, rig);
        StrippedBody body;
        for (std::size_t i = 0; i < parts_.size(); ++i) {
            if (!is_left_out_[i] || is_scenery_[i])
                continue;
            const std::vector<std::string> missing = under.missing_under(rows_of(parts_[i]));
            is_left_out_[i] = missing.empty();
            if (missing.empty())
                body.stripped.push_back(name_of_clothes(parts_[i]));
            else
                body.warnings.push_back(name_of_clothes(parts_[i])
                                        + " is not left out, as the file has no skin under it at " + list_of(missing)
                                        + "; it counts as part of the body");
        }
        body.kept = rows_without(avatar_, parts_, is_left_out_);
        return body;
    }

    const MeshFile& avatar_;
    const std::vector<MeshPart>& parts_;
    const std::vector<char>& is_scenery_;
    std::vector<char> is_left_out_;
};

std::string first_of(const std::vector<std::string>& names)
{
    const std::size_t shown = std::min(names.size(), k_most_names);
    const std::string list = list_of({ names.begin(), names.begin() + std::ptrdiff_t(shown) });
    return shown == names.size() ? list : list + " and " + std::to_string(names.size() - shown) + " more";
}

/// The node is what an artist names; a mesh is often "Cube.003".
std::string name_of_scenery(const MeshPart& part)
{
    for (const std::string* name : { &part.node, &part.mesh, &part.material })
        if (!name->empty())
            return *name;
    return "a mesh without a name";
}

/// Each once: a mesh may have many materials.
std::vector<std::string> names_of_scenery(const std::vector<MeshPart>& parts, const std::vector<char>& is_scenery)
{
    std::vector<std::string> names;
    for (std::size_t i = 0; i < parts.size(); ++i)
        if (const std::string name = name_of_scenery(parts[i]);
            is_scenery[i] && std::find(names.begin(), names.end(), name) == names.end())
            names.push_back(name);
    return names;
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

std::optional<StrippedBody> find_body(const MeshFile& avatar, Wears wears)
{
    const std::vector<MeshPart> parts = avatar.parts();
    const std::vector<char> is_scenery = find_scenery(avatar, parts);
    std::optional<StrippedBody> body;
    if (wears == Wears::strip)
        body = Stripping(avatar, parts, is_scenery).strip();
    else if (std::count(is_scenery.begin(), is_scenery.end(), 1) > 0)
        body = StrippedBody { rows_without(avatar, parts, is_scenery), {}, {}, {} };
    if (body)
        body->scenery = names_of_scenery(parts, is_scenery);
    return body;
}

void require_no_body(const MeshFile& garment)
{
    const std::optional<StrippedBody> figure = find_body(garment, Wears::strip);
    if (!figure->stripped.empty())
        throw InvalidInput(ErrorCode::invalid_input,
                           garment.path().filename().string() + ": shows a body in clothes ("
                               + list_of(figure->stripped)
                               + "), and not a garment alone; delete the body from the file, and save each garment by "
                                 "itself");
}

std::vector<std::string> notes_on(const StrippedBody& body)
{
    std::vector<std::string> notes = body.warnings;
    if (!body.stripped.empty())
        notes.push_back("left out of the body: " + list_of(body.stripped));
    if (!body.scenery.empty())
        notes.push_back("left out, as it is flat, or lies away from what joints move: " + first_of(body.scenery));
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
