// SPDX-License-Identifier: GPL-3.0-or-later
#include <climits>
#include <cmath>
#include <optional>

#include "obj_materials.h"
#include "text_content.h"

namespace garmentfit {
namespace {

struct ObjContent : TextContent {
    Appearance appearance() const override { return obj_appearance(file); }
    CornerUvs corner_uvs() const override
    {
        const Appearance look = obj_uvs(file);
        return garmentfit::corner_uvs(look.uvs, look.uv_corners);
    }
    std::vector<std::string> companions() const override { return obj_companions(file); }
    std::string naming_companions_in(const std::string& bytes, const std::string& folder) const override
    {
        return with_libraries_in(file, bytes, folder);
    }
};

/// Programs write normals as nothing reads them: without numbers, of two numbers. Such a normal is none.
std::optional<Triple> normal_in(const FileBytes& file, Words& words)
{
    Triple triple;
    for (int k = 0; k < 3; ++k) {
        if (words.done())
            return {};
        const Span word = words.next();
        const std::optional<double> number = parsed_number(file.text(word));
        if (!number || !std::isfinite(*number))
            return {};
        triple.values[k] = *number;
        triple.span = { k == 0 ? word.begin : triple.span.begin, word.end };
    }
    return triple;
}

void warn_of(std::vector<std::string>& warnings, std::size_t count, const char* what)
{
    if (count > 0)
        warnings.push_back(std::to_string(count) + what);
}

/// Vertices and normals; faces may name vertices further down, so they are read afterwards.
void read_rows(TextContent& content)
{
    RowBuilder positions, normals;
    std::size_t bad_normals = 0;
    for (Lines lines(content.file); lines.advance(true);) {
        Words words(content.file, lines.line());
        const std::string_view key = words.done() ? "" : words.next_text();
        if (key == "v") {
            const Triple triple = next_triple(words, content.file);
            content.places.push_back({ triple.span, positions.rows(), false });
            positions.add(triple.values);
        } else if (key == "vn") {
            const std::optional<Triple> triple = normal_in(content.file, words);
            if (triple)
                content.places.push_back({ triple->span, normals.rows(), true });
            else
                ++bad_normals;
            normals.add(triple ? triple->values : Vec3(Vec3::Constant(NAN)));
        }
    }
    if (positions.rows() > INT_MAX || normals.rows() > INT_MAX)
        content.file.fail("has more vertices than this program can count; decimate the mesh");
    content.positions = positions.matrix();
    content.normals = normals.matrix();
    warn_of(content.warnings, bad_normals, " normals are not three numbers; they are left as they are");
}

/// The first number of a corner, 1-based, or counted back from the newest vertex where negative.
int vertex_row(const FileBytes& file, Span word, Eigen::Index so_far, Eigen::Index all)
{
    const long long index = integer_in(file, word);
    const long long row = index < 0 ? so_far + index : index - 1;
    if (row < 0 || row >= all)
        file.fail_at_line_of(word.begin,
                             "the face refers to vertex " + std::to_string(index) + ", but there are "
                                 + std::to_string(all) + "; export the file again",
                             ErrorCode::bad_index);
    return static_cast<int>(row);
}

class FaceReader {
public:
    explicit FaceReader(const TextContent& content) : content_(content) { }

    /// Corners whose normal does not exist.
    std::size_t missing_normals() const { return missing_normals_; }
    /// Faces of one or two corners, as which some exporters write loose vertices and edges. They have no triangles.
    std::size_t narrow() const { return narrow_; }

    void count_vertex() { ++vertices_; }
    void count_normal() { ++normals_; }

    /// The words after "f": position/texture/normal, the last two optional.
    void add(Words& words)
    {
        corners_.clear();
        while (!words.done() && content_.file.bytes[words.at()] != '#')
            add_corner(words.next());
        narrow_ += corners_.size() < 6;
        fans_.add(corners_);
    }

    const FanBuilder& fans() const { return fans_; }

private:
    void add_corner(Span word)
    {
        const std::string_view text = content_.file.text(word);
        const std::size_t slash = std::min(text.find('/'), text.size());
        const std::size_t last_slash = text.rfind('/');
        corners_.push_back(
            vertex_row(content_.file, { word.begin, word.begin + slash }, vertices_, content_.positions.rows()));
        const bool has_normal
            = last_slash != std::string_view::npos && last_slash > slash && last_slash + 1 < text.size();
        corners_.push_back(has_normal ? normal_row(text.substr(last_slash + 1)) : -1);
    }

    /// -1 where there is none, or one that is no normal. Normals only turn with the surface: no reason to refuse a
    /// mesh.
    int normal_row(std::string_view text)
    {
        const std::optional<long long> index = parsed_integer(text);
        const long long row = !index ? -1 : *index < 0 ? normals_ + *index : *index - 1;
        if (row < 0 || row >= content_.normals.rows()) {
            ++missing_normals_;
            return -1;
        }
        return content_.normals.row(row).allFinite() ? static_cast<int>(row) : -1;
    }

    const TextContent& content_;
    Eigen::Index vertices_ = 0, normals_ = 0;  // so far in the file
    std::size_t missing_normals_ = 0, narrow_ = 0;
    std::vector<int> corners_;  // of one face: position, normal, position, normal, ...
    FanBuilder fans_ { 2 };
};

void read_faces(TextContent& content)
{
    FaceReader reader(content);
    for (Lines lines(content.file); lines.advance(true);) {
        Words words(content.file, lines.line());
        const std::string_view key = words.done() ? "" : words.next_text();
        if (key == "v")
            reader.count_vertex();
        else if (key == "vn")
            reader.count_normal();
        else if (key == "f" || key == "fo")  // fo: faces of old files
            reader.add(words);
    }
    content.triangles = reader.fans().triangles(0);
    content.normal_corners = reader.fans().triangles(1);
    warn_of(content.warnings, reader.missing_normals(), " corners of faces name a normal that does not exist");
    warn_of(content.warnings, reader.narrow(), " faces have fewer than three corners; they are left out");
    content.require_finite();
}

}  // namespace

ContentPtr read_obj(FileBytes file)
{
    auto content = std::make_shared<ObjContent>();
    content->format = "obj";
    content->file = std::move(file);
    read_rows(*content);
    read_faces(*content);
    return content;
}

}  // namespace garmentfit
