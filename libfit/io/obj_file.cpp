// SPDX-License-Identifier: GPL-3.0-or-later
#include <climits>

#include "obj_materials.h"
#include "text_content.h"

namespace garmentfit {
namespace {

struct ObjContent : TextContent {
    Appearance appearance() const override { return obj_appearance(file); }
    std::vector<std::string> companions() const override { return obj_companions(file); }
};

/// Vertices and normals; faces may name vertices further down, so they are read afterwards.
void read_rows(TextContent& content)
{
    RowBuilder positions, normals;
    for (Lines lines(content.file); lines.advance(true);) {
        Words words(content.file, lines.line());
        const std::string_view key = words.done() ? "" : words.next_text();
        if (key == "v") {
            const Triple triple = next_finite_triple(words, content.file);
            content.places.push_back({ triple.span, positions.rows(), false });
            positions.add(triple.values);
        } else if (key == "vn") {
            const Triple triple = next_triple(words, content.file);
            content.places.push_back({ triple.span, normals.rows(), true });
            normals.add(triple.values);
        }
    }
    if (positions.rows() > INT_MAX || normals.rows() > INT_MAX)
        content.file.fail("has more vertices than this program can count; decimate the mesh");
    content.positions = positions.matrix();
    content.normals = normals.matrix();
}

/// One of the numbers of a corner, 1-based, or counted back from the newest row where negative.
int row_named(const FileBytes& file, Span word, Eigen::Index so_far, Eigen::Index all, const char* what)
{
    const long long index = integer_in(file, word);
    const long long row = index < 0 ? so_far + index : index - 1;
    if (row < 0 || row >= all)
        file.fail_at_line_of(word.begin,
                             "the face refers to " + std::string(what) + " " + std::to_string(index)
                                 + ", but there are " + std::to_string(all) + "; export the file again",
                             ErrorCode::bad_index);
    return static_cast<int>(row);
}

class FaceReader {
public:
    explicit FaceReader(const TextContent& content) : content_(content) { }

    void count_vertex() { ++vertices_; }
    void count_normal() { ++normals_; }

    /// The words after "f": position/texture/normal, the last two optional.
    void add(Words& words)
    {
        corners_.clear();
        while (!words.done() && content_.file.bytes[words.at()] != '#')
            add_corner(words.next());
        if (corners_.size() < 6)
            content_.file.fail_at_line_of(words.at(),
                                          "the face has " + std::to_string(corners_.size() / 2)
                                              + " corners; give it three or more, or remove it");
        fans_.add(corners_);
    }

    const FanBuilder& fans() const { return fans_; }

private:
    void add_corner(Span word)
    {
        const std::string_view text = content_.file.text(word);
        const std::size_t slash = std::min(text.find('/'), text.size());
        const std::size_t last_slash = text.rfind('/');
        corners_.push_back(row_named(content_.file, { word.begin, word.begin + slash }, vertices_,
                                     content_.positions.rows(), "vertex"));
        const bool has_normal
            = last_slash != std::string_view::npos && last_slash > slash && last_slash + 1 < text.size();
        corners_.push_back(!has_normal ? -1
                                       : row_named(content_.file, { word.begin + last_slash + 1, word.end }, normals_,
                                                   content_.normals.rows(), "normal"));
    }

    const TextContent& content_;
    Eigen::Index vertices_ = 0, normals_ = 0;  // so far in the file
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
