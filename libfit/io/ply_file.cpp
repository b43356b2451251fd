// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <bit>
#include <climits>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "mesh_content.h"
#include "turned_normals.h"
#include "words.h"

namespace garmentfit {
namespace {

enum class Scalar { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct ScalarName {
    std::string_view name, alias;
    int bytes;
};

constexpr std::array<ScalarName, 8> k_scalars { { { "char", "int8", 1 },
                                                  { "uchar", "uint8", 1 },
                                                  { "short", "int16", 2 },
                                                  { "ushort", "uint16", 2 },
                                                  { "int", "int32", 4 },
                                                  { "uint", "uint32", 4 },
                                                  { "float", "float32", 4 },
                                                  { "double", "float64", 8 } } };

int size_of(Scalar type) { return k_scalars[static_cast<int>(type)].bytes; }
bool is_real(Scalar type) { return type == Scalar::float32 || type == Scalar::float64; }

struct Property {
    std::string name;
    Scalar type = Scalar::float32;
    std::optional<Scalar> count;  ///< of a list
};

struct Element {
    std::string name;
    std::size_t rows = 0;
    std::vector<Property> properties;
};

enum class Encoding { ascii, little_endian, big_endian };

struct Header {
    Encoding encoding = Encoding::ascii;
    std::vector<Element> elements;
    std::size_t body = 0;  ///< where the data begins
};

Scalar scalar_of(const FileBytes& file, Span word)
{
    const std::string_view name = file.text(word);
    for (std::size_t i = 0; i < k_scalars.size(); ++i)
        if (name == k_scalars[i].name || name == k_scalars[i].alias)
            return static_cast<Scalar>(i);
    file.fail_at_line_of(word.begin, "unknown property type '" + std::string(name) + "'; export the file again");
}

Encoding encoding_of(const FileBytes& file, Words& words)
{
    const Span word = words.next();
    if (file.text(word) == "ascii")
        return Encoding::ascii;
    if (file.text(word) == "binary_little_endian")
        return Encoding::little_endian;
    if (file.text(word) == "binary_big_endian")
        return Encoding::big_endian;
    file.fail_at_line_of(word.begin,
                         "unknown PLY encoding; export as ascii, binary_little_endian or binary_big_endian");
}

Property property_of(const FileBytes& file, Words& words)
{
    Property property;
    Span word = words.next();
    if (file.text(word) == "list") {
        property.count = scalar_of(file, words.next());
        if (is_real(*property.count))
            file.fail_at_line_of(word.begin, "the length of a list is a real number; export it with an integer type");
        word = words.next();
    }
    property.type = scalar_of(file, word);
    property.name = words.next_text();
    return property;
}

Element element_of(const FileBytes& file, Words& words)
{
    Element element;
    element.name = words.next_text();
    const Span word = words.next();
    const long long rows = integer_in(file, word);
    if (rows < 0 || rows > INT_MAX)
        file.fail_at_line_of(word.begin,
                             "element count " + std::to_string(rows) + " is out of range; export the file again");
    element.rows = static_cast<std::size_t>(rows);
    return element;
}

Header read_header(const FileBytes& file)
{
    Header header;
    bool has_format = false;
    for (Lines lines(file); lines.advance();) {
        Words words(file, lines.line());
        const std::string_view key = words.done() ? "" : words.next_text();
        if (key == "format") {
            header.encoding = encoding_of(file, words);
            has_format = true;
        } else if (key == "element") {
            header.elements.push_back(element_of(file, words));
        } else if (key == "property") {
            if (header.elements.empty())
                file.fail_at_line_of(lines.line().begin, "property before the first element; export the file again");
            header.elements.back().properties.push_back(property_of(file, words));
        } else if (key == "end_header") {
            if (!has_format)
                file.fail("the PLY header has no format line; export the file again");
            header.body = std::min(lines.line().end + 1, file.bytes.size());
            return header;
        } else if (key != "ply" && key != "comment" && key != "obj_info" && !key.empty()) {
            file.fail_at_line_of(lines.line().begin, "unknown word in the PLY header; export the file again");
        }
    }
    file.fail("the PLY header has no end_header line; the file is truncated or mangled, export or copy it again");
}

/// The data after the header, value by value.
class Body {
public:
    Body(const FileBytes& file, const Header& header) :
        file_(file), encoding_(header.encoding), at_(header.body),
        words_(file, { header.body, file.bytes.size() }), place_ { header.body, header.body }
    {
    }

    double next(Scalar type)
    {
        if (encoding_ == Encoding::ascii)
            return next_word(type);
        const std::size_t bytes = size_of(type);
        if (file_.bytes.size() - at_ < bytes)
            file_.fail_at_byte(file_.bytes.size(), "the file ends too soon; it is truncated, export or copy it again");
        place_ = { at_, at_ + bytes };
        at_ += bytes;
        return decode(type);
    }

    /// Where the last value stood.
    Span place() const { return place_; }

    /// Checks a count against what the file can still hold, before anything is allocated for it.
    void require(std::size_t count, std::size_t least_bytes) const
    {
        if (count > (file_.bytes.size() - at_) / least_bytes)
            fail("a count of " + std::to_string(count)
                 + " is more than the file can hold; it is truncated or mangled, export or copy it again");
    }

    /// The least that a value takes in this file.
    std::size_t least_bytes(Scalar type) const { return encoding_ == Encoding::ascii ? 1 : size_of(type); }

    [[noreturn]] void fail(const std::string& what, ErrorCode code = ErrorCode::unreadable_file) const
    {
        fail_at(place_, what, code);
    }
    [[noreturn]] void fail_at(Span place, const std::string& what, ErrorCode code) const
    {
        if (encoding_ == Encoding::ascii)
            file_.fail_at_line_of(place.begin, what, code);
        file_.fail_at_byte(place.begin, what, code);
    }

private:
    double next_word(Scalar type)
    {
        place_ = words_.next();
        at_ = place_.end;
        return is_real(type) ? number_in(file_, place_) : static_cast<double>(integer_in(file_, place_));
    }

    template <class Number>
    double decode_as() const
    {
        std::array<char, sizeof(Number)> raw;
        std::copy_n(file_.bytes.begin() + place_.begin, raw.size(), raw.begin());
        if ((encoding_ == Encoding::big_endian) == (std::endian::native == std::endian::little))
            std::reverse(raw.begin(), raw.end());
        return static_cast<double>(std::bit_cast<Number>(raw));
    }

    double decode(Scalar type) const
    {
        switch (type) {
        case Scalar::int8: return decode_as<std::int8_t>();
        case Scalar::uint8: return decode_as<std::uint8_t>();
        case Scalar::int16: return decode_as<std::int16_t>();
        case Scalar::uint16: return decode_as<std::uint16_t>();
        case Scalar::int32: return decode_as<std::int32_t>();
        case Scalar::uint32: return decode_as<std::uint32_t>();
        case Scalar::float32: return decode_as<float>();
        default: return decode_as<double>();
        }
    }

    const FileBytes& file_;
    Encoding encoding_;
    std::size_t at_;
    Words words_;
    Span place_;
};

void read_list(Body& body, const Property& property, std::vector<double>& values)
{
    const double count = body.next(*property.count);
    if (count < 0)
        body.fail("a list has a negative length; export the file again");
    body.require(static_cast<std::size_t>(count), body.least_bytes(property.type));
    values.resize(static_cast<std::size_t>(count));
    for (double& value : values)
        value = body.next(property.type);
}

/// Reads an element: on_scalar(row, property, value), on_list(row, property, values).
template <class OnScalar, class OnList>
void walk(Body& body, const Element& element, OnScalar on_scalar, OnList on_list)
{
    if (element.properties.empty())
        return;
    std::size_t least_bytes = 0;
    for (const Property& property : element.properties)
        least_bytes += body.least_bytes(property.count.value_or(property.type));
    body.require(element.rows, least_bytes);
    std::vector<double> list;
    for (std::size_t row = 0; row < element.rows; ++row)
        for (std::size_t p = 0; p < element.properties.size(); ++p) {
            const Property& property = element.properties[p];
            if (property.count) {
                read_list(body, property, list);
                on_list(row, p, list);
            } else {
                on_scalar(row, p, body.next(property.type));
            }
        }
}

void skip(Body& body, const Element& element)
{
    walk(
        body, element, [](auto...) {}, [](auto&&...) {});
}

int property_named(const Element& element, std::string_view name)
{
    for (std::size_t p = 0; p < element.properties.size(); ++p)
        if (element.properties[p].name == name)
            return static_cast<int>(p);
    return -1;
}

const Element& vertex_element(const FileBytes& file, const Header& header)
{
    const Element* found = nullptr;
    for (const Element& element : header.elements)
        if (element.name == "vertex" && std::exchange(found, &element))
            file.fail("the PLY header has two vertex elements; export the file with one mesh");
    if (!found)
        file.fail("the PLY header has no vertex element; export a mesh");
    return *found;
}

/// Which of x, y, z, nx, ny, nz each vertex property is; -1 = none of them.
std::vector<int> columns_of(const FileBytes& file, const Element& vertex)
{
    constexpr std::array<std::string_view, 6> names { "x", "y", "z", "nx", "ny", "nz" };
    const bool has_normals
        = property_named(vertex, "nx") >= 0 && property_named(vertex, "ny") >= 0 && property_named(vertex, "nz") >= 0;
    std::vector<int> columns(vertex.properties.size(), -1);
    for (int column = 0; column < (has_normals ? 6 : 3); ++column) {
        const int p = property_named(vertex, names[column]);
        if (p < 0 || vertex.properties[p].count || !is_real(vertex.properties[p].type))
            file.fail("the vertices have no property " + std::string(names[column])
                      + " of type float or double; export positions as floats");
        columns[p] = column;
    }
    return columns;
}

using Table = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;  // x y z nx ny nz

/// @param not_finite  gets the places of such coordinates by vertex, the last one of each
Table read_vertices(Body& body, const Element& element, const std::vector<int>& columns,
                    std::map<Eigen::Index, Span>& not_finite)
{
    body.require(element.rows, element.properties.size());
    Table table = Table::Zero(element.rows, 6);
    const auto on_scalar = [&](std::size_t row, std::size_t p, double value) {
        if (columns[p] < 0)
            return;
        if (columns[p] < 3 && !std::isfinite(value))
            not_finite[Eigen::Index(row)] = body.place();
        table(row, columns[p]) = value;
    };
    walk(body, element, on_scalar, [](auto&&...) {});
    return table;
}

std::vector<int> corners_of(const Body& body, std::size_t face, const std::vector<double>& list, std::size_t vertices)
{
    if (list.size() < 3)
        body.fail("face " + std::to_string(face) + " has " + std::to_string(list.size())
                  + " corners; give it three or more, or remove it");
    std::vector<int> corners;
    for (const double index : list) {
        if (!(index >= 0 && index < static_cast<double>(vertices)) || index != std::floor(index))
            body.fail("face " + std::to_string(face) + " refers to vertex " + text_of(index) + ", but there are "
                          + std::to_string(vertices) + ", counted from 0; export the file again",
                      ErrorCode::bad_index);
        corners.push_back(static_cast<int>(index));
    }
    return corners;
}

/// The list of corners; -1 = none.
int corners_property(const Element& element)
{
    int indices = property_named(element, "vertex_indices");
    if (indices < 0)
        indices = property_named(element, "vertex_index");
    return indices >= 0 && element.properties[indices].count ? indices : -1;
}

void read_faces(Body& body, const Element& element, std::size_t vertices, FanBuilder& fans)
{
    const int indices = corners_property(element);
    if (indices < 0)
        body.fail("the faces have no list vertex_indices or vertex_index; export faces with one of them");
    const auto on_list = [&](std::size_t row, std::size_t p, const std::vector<double>& list) {
        if (static_cast<int>(p) == indices)
            fans.add(corners_of(body, row, list, vertices));
    };
    walk(
        body, element, [](auto...) {}, on_list);
}

template <class Number>
std::string raw_bytes(Number value, bool big_endian)
{
    auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(value);
    if (big_endian == (std::endian::native == std::endian::little))
        std::reverse(raw.begin(), raw.end());
    return { raw.begin(), raw.end() };
}

std::string encode(double value, Scalar type, Encoding encoding)
{
    const bool single = type == Scalar::float32;
    if (encoding == Encoding::ascii)
        return single ? text_of(static_cast<float>(value)) : text_of(value);
    const bool big_endian = encoding == Encoding::big_endian;
    return single ? raw_bytes(static_cast<float>(value), big_endian) : raw_bytes(value, big_endian);
}

std::string header_text(Eigen::Index vertices, Eigen::Index faces, const std::vector<VertexProperty>& properties,
                        const std::vector<std::string>& comments)
{
    std::string header = "ply\nformat binary_little_endian 1.0\n";
    for (const std::string& comment : comments)
        header += "comment " + comment + '\n';
    header
        += "element vertex " + std::to_string(vertices) + "\nproperty double x\nproperty double y\nproperty double z\n";
    for (const VertexProperty& property : properties)
        header += (property.integer ? "property int " : "property double ") + property.name + '\n';
    return header + "element face " + std::to_string(faces) + "\nproperty list uchar int vertex_indices\nend_header\n";
}

/// Of vertices, in the order of the header; lists stay empty.
std::vector<std::vector<double>> read_vertex_scalars(const FileBytes& file, const Header& header)
{
    const Element& vertex = vertex_element(file, header);
    std::vector<std::vector<double>> result(vertex.properties.size());
    Body body(file, header);
    for (const Element& element : header.elements) {
        if (&element == &vertex) {
            walk(
                body, element, [&](std::size_t, std::size_t p, double value) { result[p].push_back(value); },
                [](auto&&...) {});
            break;
        }
        skip(body, element);
    }
    return result;
}

/// What programs call texture coordinates of vertices.
constexpr std::array<std::array<const char*, 2>, 4> k_uv_names {
    { { "u", "v" }, { "s", "t" }, { "texture_u", "texture_v" }, { "texcoord_u", "texcoord_v" } }
};

/// What MeshLab calls the list of texture coordinates of a face: u, v of each corner.
constexpr std::string_view k_wedge_uvs = "texcoord";

/// No rows where the faces have no such list; NaN at those whose list has another length.
CornerUvs read_wedge_uvs(const FileBytes& file, const Header& header)
{
    const auto face = std::find_if(header.elements.begin(), header.elements.end(),
                                   [](const Element& element) { return element.name == "face"; });
    if (face == header.elements.end())
        return {};
    const int indices = corners_property(*face), wedges = property_named(*face, k_wedge_uvs);
    if (indices < 0 || wedges < 0 || !face->properties[wedges].count)
        return {};
    Body body(file, header);
    for (auto before = header.elements.begin(); before != face; ++before)
        skip(body, *before);
    std::vector<std::size_t> corners(face->rows);
    std::vector<std::vector<double>> lists(face->rows);
    const auto on_list = [&](std::size_t row, std::size_t p, const std::vector<double>& list) {
        if (int(p) == indices)
            corners[row] = list.size();
        else if (int(p) == wedges)
            lists[row] = list;
    };
    walk(
        body, *face, [](auto...) {}, on_list);
    std::vector<double> uvs;
    FanBuilder fans;
    for (std::size_t row = 0; row < face->rows; ++row) {
        const bool has_uvs = lists[row].size() == 2 * corners[row];
        std::vector<int> rows(corners[row], -1);
        if (has_uvs) {
            std::iota(rows.begin(), rows.end(), int(uvs.size() / 2));
            uvs.insert(uvs.end(), lists[row].begin(), lists[row].end());
        }
        fans.add(rows);
    }
    return corner_uvs(Eigen::Map<const Appearance::Uvs>(uvs.data(), Eigen::Index(uvs.size() / 2), 2), fans.triangles());
}

struct PlyContent : MeshFile::Content {
    FileBytes file;
    Header header;
    std::vector<int> columns;
    Positions normals;  ///< zero where the file has none

    CornerUvs corner_uvs() const override
    {
        const Element& vertex = vertex_element(file, header);
        for (const auto& names : k_uv_names) {
            const int u = property_named(vertex, names[0]), v = property_named(vertex, names[1]);
            if (u < 0 || v < 0)
                continue;
            const auto values = read_vertex_scalars(file, header);
            if (values[u].size() < vertex.rows || values[v].size() < vertex.rows)  // lists
                continue;
            Appearance::Uvs uvs(vertex.rows, 2);
            for (Eigen::Index i = 0; i < uvs.rows(); ++i)
                uvs.row(i) << values[u][i], values[v][i];
            return garmentfit::corner_uvs(uvs, triangles);
        }
        return read_wedge_uvs(file, header);
    }

    double against_faces() const override { return share_against_faces(normals, triangles, triangles, positions); }

    Table table_with(const Positions& moved) const
    {
        Table table(moved.rows(), 6);
        table.leftCols<3>() = moved;
        table.rightCols<3>() = turn_normals(normals, triangles, triangles, positions, moved);
        return table;
    }

    std::string bytes_with(const Positions& moved) const override
    {
        Table before(positions.rows(), 6);
        before << positions, normals;
        const Table after = table_with(moved);
        Body body(file, header);
        Rewriter rewriter(file.bytes);
        const Element& vertex = vertex_element(file, header);
        const auto on_scalar = [&](std::size_t row, std::size_t p, double value) {
            const int column = columns[p];
            if (column >= 0 && after(row, column) != before(row, column) && !std::isnan(value))
                rewriter.replace(body.place(), encode(after(row, column), vertex.properties[p].type, header.encoding));
        };
        for (const Element& element : header.elements) {
            if (&element == &vertex) {
                walk(body, element, on_scalar, [](auto&&...) {});
                break;
            }
            skip(body, element);
        }
        return rewriter.finish();
    }
};

}  // namespace

ContentPtr read_ply(FileBytes file)
{
    auto content = std::make_shared<PlyContent>();
    content->format = "ply";
    content->header = read_header(file);
    const Element& vertex = vertex_element(file, content->header);
    content->columns = columns_of(file, vertex);
    Body body(file, content->header);
    FanBuilder fans;
    std::map<Eigen::Index, Span> not_finite;
    for (const Element& element : content->header.elements) {
        if (&element == &vertex) {
            const Table table = read_vertices(body, element, content->columns, not_finite);
            content->positions = table.leftCols<3>();
            content->normals = table.rightCols<3>();
        } else if (element.name == "face") {
            read_faces(body, element, vertex.rows, fans);
        } else {
            skip(body, element);
        }
    }
    content->triangles = fans.triangles();
    if (const Eigen::Index row = first_not_finite(*content); row >= 0)
        body.fail_at(not_finite.at(row), "vertex " + std::to_string(row) + " is not finite; repair the file",
                     ErrorCode::not_finite);
    content->file = std::move(file);
    return content;
}

std::vector<VertexProperty> read_ply_properties(const std::filesystem::path& path)
{
    const FileBytes file = read_file(path);
    const Header header = read_header(file);
    const Element& vertex = vertex_element(file, header);
    std::vector<std::vector<double>> values = read_vertex_scalars(file, header);
    std::vector<VertexProperty> result;
    for (std::size_t p = 0; p < values.size(); ++p)
        result.push_back({ vertex.properties[p].name, std::move(values[p]), !is_real(vertex.properties[p].type) });
    std::erase_if(result, [&](const VertexProperty& property) { return property.values.size() != vertex.rows; });
    return result;
}

void write_ply(const std::filesystem::path& path, const Positions& positions, const Triangles& triangles,
               const std::vector<VertexProperty>& properties, const std::vector<std::string>& comments)
{
    std::string bytes = header_text(positions.rows(), triangles.rows(), properties, comments);
    for (Eigen::Index v = 0; v < positions.rows(); ++v) {
        for (int k = 0; k < 3; ++k)
            bytes += raw_bytes(positions(v, k), false);
        for (const VertexProperty& property : properties)
            bytes += property.integer ? raw_bytes(static_cast<std::int32_t>(property.values.at(v)), false)
                                      : raw_bytes(property.values.at(v), false);
    }
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        bytes += '\3';
        for (int k = 0; k < 3; ++k)
            bytes += raw_bytes(static_cast<std::int32_t>(triangles(f, k)), false);
    }
    write_file(path, bytes);
}

}  // namespace garmentfit
