// SPDX-License-Identifier: GPL-3.0-or-later
#include "obj_materials.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>

#include "mesh_content.h"
#include "pictures.h"
#include "words.h"

namespace garmentfit {
namespace {

namespace fs = std::filesystem;

/// Names may hold blanks, so they go on to the end of the line. Programs of Windows write backslashes.
std::string rest_of_line(const FileBytes& file, const Words& words, Span line)
{
    std::string name(file.text({ std::min(words.at(), line.end), line.end }));
    const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
    name.erase(name.begin(), std::find_if_not(name.begin(), name.end(), is_blank));
    name.erase(std::find_if_not(name.rbegin(), name.rend(), is_blank).base(), name.end());
    std::replace(name.begin(), name.end(), '\\', '/');
    return name;
}

/// 0 where it is none: materials are not worth an error.
double lenient_number(std::string_view text)
{
    double value = 0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return std::isfinite(value) ? value : 0;
}

double next_share(Words& words) { return words.done() ? 0 : std::clamp(lenient_number(words.next_text()), 0.0, 1.0); }

Eigen::Vector3d next_colour(Words& words)
{
    Eigen::Vector3d colour;
    for (double& channel : colour)
        channel = next_share(words);
    return colour;
}

/// What a statement such as `map_Kd -s 1 1 1 -bm 0.5 cloth.png` names, after its options.
std::string picture_of(const FileBytes& file, Words& words, Span line)
{
    static const std::map<std::string_view, int> single { { "-blendu", 1 }, { "-blendv", 1 },  { "-boost", 1 },
                                                          { "-mm", 2 },     { "-texres", 1 },  { "-clamp", 1 },
                                                          { "-bm", 1 },     { "-imfchan", 1 }, { "-type", 1 },
                                                          { "-cc", 1 } };
    for (Words ahead = words; !ahead.done(); ahead = words) {
        const std::string_view option = ahead.next_text();
        const bool is_vector = option == "-o" || option == "-s" || option == "-t";
        const auto known = single.find(option);
        if (!is_vector && known == single.end())
            break;
        words = ahead;
        for (int left = is_vector ? 3 : known->second; left > 0 && !ahead.done(); --left) {
            const std::string_view value = ahead.next_text();
            double number = 0;
            if (is_vector && std::from_chars(value.data(), value.data() + value.size(), number).ptr == value.data())
                break;  // one or two numbers are allowed, too
            words = ahead;
        }
    }
    return rest_of_line(file, words, line);
}

bool is_picture_key(std::string_view key)
{
    return key.starts_with("map_") || key == "bump" || key == "norm" || key == "disp" || key == "decal"
        || key == "refl";
}

/// Adds the materials of one .mtl file.
class MaterialReader {
public:
    MaterialReader(Appearance& look, std::map<std::string, int>& rows, const FileBytes& file) :
        look_(look), rows_(rows), file_(file)
    {
    }

    void read()
    {
        for (Lines lines(file_); lines.advance(true);) {
            Words words(file_, lines.line());
            const std::string key(words.done() ? "" : words.next_text());
            if (key == "newmtl")
                begin(rest_of_line(file_, words, lines.line()));
            else if (material_ >= 0)
                read_statement(key, words, lines.line());
        }
    }

private:
    void begin(const std::string& name)
    {
        material_ = int(look_.materials.size());
        rows_.try_emplace(name, material_);  // of equal names the first, as other programs do
        look_.materials.emplace_back().name = name;
    }

    void read_statement(const std::string& key, Words& words, Span line)
    {
        SurfaceMaterial& material = look_.materials[std::size_t(material_)];
        if (key == "Kd")
            material.colour.head<3>() = next_colour(words);
        else if (key == "Ke")
            material.emission = next_colour(words);
        else if (key == "d")
            set_opacity(material, next_share(words));
        else if (key == "Tr")
            set_opacity(material, 1 - next_share(words));
        else if (key == "Pr")
            material.roughness = next_share(words);
        else if (key == "Pm")
            material.metallic = next_share(words);
        else if (key == "map_Kd") {
            material.colour_picture = picture(picture_of(file_, words, line));
            if (material.colour_picture >= 0)
                material.colour.head<3>().setOnes();  // programs differ in whether Kd tints it; most write a grey one
        } else if (key == "map_Ke") {
            material.emission_picture = picture(picture_of(file_, words, line));
            if (material.emission_picture >= 0)
                material.emission.setOnes();
        } else if (key == "norm" || key == "map_Kn")
            material.normal_picture = picture(picture_of(file_, words, line));
        else if (is_picture_key(key))
            look_.warnings.push_back(fs::path(file_.name).filename().string() + ": " + key + " of material "
                                     + material.name + " has no counterpart in glTF and is left out");
    }

    static void set_opacity(SurfaceMaterial& material, double opacity)
    {
        material.colour[3] = opacity;
        material.alpha = opacity < 1 ? "BLEND" : "OPAQUE";
    }

    /// Of the same name the same row.
    int picture(const std::string& name)
    {
        const auto [entry, is_new] = pictures_.try_emplace(name, -1);
        if (is_new && !name.empty())
            try {
                const FileBytes file = read_file(fs::path(file_.name).parent_path() / name);
                const std::string short_name = fs::path(name).filename().string();
                if (const std::string warning = warning_of_size(short_name, file.bytes); !warning.empty())
                    look_.warnings.push_back(warning);
                entry->second = add_picture(look_, short_name, file.bytes);
            } catch (const InvalidInput&) {
                look_.warnings.push_back(fs::path(file_.name).filename().string() + ": texture " + name
                                         + " cannot be read; put it beside the file");
            }
        return entry->second;
    }

    Appearance& look_;
    std::map<std::string, int>& rows_;
    const FileBytes& file_;
    std::map<std::string, int> pictures_;
    int material_ = -1;
};

/// The names in a line that begins with mtllib: one file with blanks in its name, or several without.
std::vector<std::string> libraries_in(const FileBytes& file, Words words, Span line)
{
    const std::string whole = rest_of_line(file, words, line);
    if (std::error_code none; fs::exists(fs::path(file.name).parent_path() / whole, none))
        return { whole };
    std::vector<std::string> names;
    while (!words.done()) {
        std::string name(words.next_text());
        std::replace(name.begin(), name.end(), '\\', '/');
        names.push_back(name);
    }
    return names;
}

std::vector<std::string> libraries_of(const FileBytes& file)
{
    std::vector<std::string> names;
    for (Lines lines(file); lines.advance(true);) {
        Words words(file, lines.line());
        if (words.done() || words.next_text() != "mtllib")
            continue;
        const std::vector<std::string> more = libraries_in(file, words, lines.line());
        names.insert(names.end(), more.begin(), more.end());
    }
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return names;
}

std::optional<FileBytes> read_library(const FileBytes& obj, const std::string& name)
{
    try {
        return read_file(fs::path(obj.name).parent_path() / name);
    } catch (const InvalidInput&) {
        return {};
    }
}

/// UVs and materials of the corners of polygons, cut into the same fans as the faces.
class CornerReader {
public:
    CornerReader(Appearance& look, const std::map<std::string, int>& materials) : look_(look), materials_(materials) { }

    void read(const FileBytes& file)
    {
        for (Lines lines(file); lines.advance(true);) {  // faces may name rows further down
            Words words(file, lines.line());
            if (!words.done() && words.next_text() == "vt")
                add_uv(words);
        }
        for (Lines lines(file); lines.advance(true);) {
            Words words(file, lines.line());
            const std::string_view key = words.done() ? "" : words.next_text();
            if (key == "vt")
                ++rows_so_far_;
            else if (key == "usemtl")
                use(rest_of_line(file, words, lines.line()));
            else if (key == "f" || key == "fo")
                add_face(file, words);
        }
        look_.uv_corners = fans_.triangles();
        look_.uvs = Eigen::Map<const decltype(look_.uvs)>(values_.data(), Eigen::Index(values_.size() / 2), 2);
        if (look_.uvs.rows() == 0 || look_.uv_corners.maxCoeff() < 0)
            look_.uv_corners.resize(0, 3);
        if (std::all_of(look_.material_of.begin(), look_.material_of.end(), [](int m) { return m < 0; }))
            look_.material_of.clear();
    }

private:
    /// Equal UVs are one, so that corners of different faces share a vertex.
    void add_uv(Words& words)
    {
        std::pair<double, double> uv { 0, 0 };
        uv.first = words.done() ? 0 : lenient_number(words.next_text());
        uv.second = 1 - (words.done() ? 0 : lenient_number(words.next_text()));
        const auto [entry, is_new] = row_of_.try_emplace(uv, int(values_.size() / 2));
        if (is_new)
            values_.insert(values_.end(), { uv.first, uv.second });
        rows_.push_back(entry->second);
    }

    void use(const std::string& name)
    {
        const auto known = materials_.find(name);
        material_ = known == materials_.end() ? -1 : known->second;
    }

    void add_face(const FileBytes& file, Words& words)
    {
        corners_.clear();
        while (!words.done() && file.bytes[words.at()] != '#')
            corners_.push_back(uv_of(words.next_text()));
        fans_.add(corners_);
        look_.material_of.insert(look_.material_of.end(), std::max<std::size_t>(corners_.size(), 2) - 2, material_);
    }

    /// The second number of position/texture/normal, 1-based or counted back.
    int uv_of(std::string_view corner) const
    {
        const std::size_t slash = corner.find('/');
        if (slash == std::string_view::npos)
            return -1;
        const std::string_view text = corner.substr(slash + 1);
        long long index = 0;
        std::from_chars(text.data(), text.data() + text.size(), index);
        const long long row = index < 0 ? rows_so_far_ + index : index - 1;
        return row < 0 || row >= static_cast<long long>(rows_.size()) ? -1 : rows_[std::size_t(row)];
    }

    Appearance& look_;
    const std::map<std::string, int>& materials_;
    std::map<std::pair<double, double>, int> row_of_;
    std::vector<double> values_;
    std::vector<int> rows_;  // of each vt
    long long rows_so_far_ = 0;  // in the file
    std::vector<int> corners_;
    FanBuilder fans_;
    int material_ = -1;
};

}  // namespace

Appearance obj_appearance(const FileBytes& file)
{
    Appearance look;
    std::map<std::string, int> rows;
    for (const std::string& name : libraries_of(file)) {
        if (const std::optional<FileBytes> library = read_library(file, name))
            MaterialReader(look, rows, *library).read();
        else
            look.warnings.push_back("materials " + name + " cannot be read; put the file beside the mesh");
    }
    CornerReader(look, rows).read(file);
    return look;
}

Appearance obj_uvs(const FileBytes& file)
{
    Appearance look;
    const std::map<std::string, int> no_materials;
    CornerReader(look, no_materials).read(file);
    return look;
}

std::vector<std::string> obj_companions(const FileBytes& file)
{
    std::vector<std::string> names = libraries_of(file);
    for (std::size_t i = 0, libraries = names.size(); i < libraries; ++i)
        if (const std::optional<FileBytes> library = read_library(file, names[i]))
            for (Lines lines(*library); lines.advance(true);) {
                Words words(*library, lines.line());
                if (words.done() || !is_picture_key(words.next_text()))
                    continue;
                if (const std::string name = picture_of(*library, words, lines.line()); !name.empty())
                    names.push_back((fs::path(names[i]).parent_path() / name).generic_string());
            }
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return names;
}

std::string with_libraries_in(const FileBytes& given, const std::string& bytes, const std::string& folder)
{
    const FileBytes file { given.name, bytes };
    Rewriter rewriter(file.bytes);
    for (Lines lines(file); lines.advance(true);) {
        Words words(file, lines.line());
        if (words.done() || words.next_text() != "mtllib")
            continue;
        std::string names;
        for (const std::string& name : libraries_in(file, words, lines.line()))
            names += " " + folder + "/" + name;
        rewriter.replace({ words.at(), lines.line().end }, names);
    }
    return rewriter.finish();
}

}  // namespace garmentfit
