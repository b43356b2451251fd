// SPDX-License-Identifier: GPL-3.0-or-later
#include "text_content.h"

#include <climits>
#include <optional>

namespace garmentfit {
namespace {

/// The lines that hold more than blanks and comments, one after the other.
class Rows {
public:
    explicit Rows(const FileBytes& file) : file_(file), lines_(file) { }

    std::optional<Words> next()
    {
        while (lines_.advance()) {
            Span span = lines_.line();
            if (const std::size_t comment = file_.text(span).find('#'); comment != std::string_view::npos)
                span.end = span.begin + comment;
            Words words(file_, span);
            if (!words.done())
                return words;
        }
        return std::nullopt;
    }

    Words required()
    {
        if (std::optional<Words> words = next())
            return *words;
        file_.fail_at_line_of(file_.bytes.size(), "the file ends too soon; it is truncated, export or copy it again");
    }

private:
    const FileBytes& file_;
    Lines lines_;
};

struct Header {
    bool has_normals = false;
    int vertices = 0, faces = 0;
};

/// "OFF", "COFF", "STCNOFF", ...; not vertices of other dimensions (4OFF, nOFF).
bool is_keyword(std::string_view word)
{
    for (const std::string_view prefix : { "ST", "C", "N" })
        if (word.starts_with(prefix))
            word.remove_prefix(prefix.size());
    return word == "OFF";
}

int count_in(const FileBytes& file, Words& words)
{
    const Span word = words.next();
    const long long count = integer_in(file, word);
    if (count < 0 || count > INT_MAX || static_cast<std::size_t>(count) > file.bytes.size())
        file.fail_at_line_of(
            word.begin,
            "a count of " + std::to_string(count)
                + " is more than the file can hold; it is truncated or mangled, export or copy it again");
    return static_cast<int>(count);
}

Header read_header(const FileBytes& file, Rows& rows)
{
    Header header;
    Words words = rows.required();
    const std::string_view keyword = words.next_text();
    if (!is_keyword(keyword))
        file.fail("the first word is not OFF; the header is mangled, export the file again");
    header.has_normals = keyword.find('N') != std::string_view::npos;
    if (words.done())
        words = rows.required();
    else if (file.text({ words.at(), words.at() + 6 }) == "BINARY")
        file.fail("is a binary OFF file; save it as text");
    header.vertices = count_in(file, words);
    header.faces = count_in(file, words);
    return header;
}

void read_vertices(TextContent& content, Rows& rows, const Header& header)
{
    RowBuilder positions, normals;
    for (int v = 0; v < header.vertices; ++v) {
        Words words = rows.required();
        const Triple position = next_triple(words, content.file);
        content.places.push_back({ position.span, v, false });
        positions.add(position.values);
        if (header.has_normals) {
            const Triple normal = next_triple(words, content.file);
            content.places.push_back({ normal.span, v, true });
            normals.add(normal.values);
        }
    }
    content.positions = positions.matrix();
    content.normals = normals.matrix();
}

std::vector<int> corners_in(const FileBytes& file, Words& words, int vertices)
{
    const int count = count_in(file, words);
    if (count < 3)
        file.fail_at_line_of(words.at(),
                             "the face has " + std::to_string(count) + " corners; give it three or more, or remove it");
    std::vector<int> corners;
    for (int k = 0; k < count; ++k) {
        const long long index = words.next_integer();
        if (index < 0 || index >= vertices)
            file.fail_at_line_of(words.at(),
                                 "the face refers to vertex " + std::to_string(index) + ", but there are "
                                     + std::to_string(vertices) + ", counted from 0; export the file again",
                                 ErrorCode::bad_index);
        corners.push_back(static_cast<int>(index));
    }
    return corners;
}

}  // namespace

bool is_off(const FileBytes& file)
{
    std::optional<Words> words = Rows(file).next();
    return words && is_keyword(words->next_text());
}

ContentPtr read_off(FileBytes file)
{
    auto content = std::make_shared<TextContent>();
    content->format = "off";
    content->file = std::move(file);
    Rows rows(content->file);
    const Header header = read_header(content->file, rows);
    read_vertices(*content, rows, header);
    FanBuilder fans;
    for (int f = 0; f < header.faces; ++f) {
        Words words = rows.required();
        fans.add(corners_in(content->file, words, header.vertices));
    }
    content->triangles = fans.triangles();
    content->normal_corners
        = header.has_normals ? content->triangles : Triangles::Constant(content->triangles.rows(), 3, -1);
    content->require_finite();
    return content;
}

}  // namespace garmentfit
