// SPDX-License-Identifier: GPL-3.0-or-later
#include "text_content.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <climits>
#include <cstdint>
#include <cstring>
#include <unordered_map>

#include "turned_normals.h"

namespace garmentfit {
namespace {

/// Merges equal vertices: STL repeats a vertex in every facet.
class FacetWeld {
public:
    /// Reserves memory for the vertices of a closed surface. derived: Euler, two facets a vertex.
    void expect_facets(std::size_t facets) { rows_.reserve(facets / 2 + 2); }

    int row_of(const Vec3& position)
    {
        const auto [entry, is_new]
            = rows_.try_emplace({ position.x(), position.y(), position.z() }, static_cast<int>(positions_.rows()));
        if (is_new)
            positions_.add(position);
        return entry->second;
    }
    Positions positions() const { return positions_.matrix(); }

private:
    using Key = std::array<double, 3>;
    struct Hash {
        std::size_t operator()(const Key& key) const
        {
            std::size_t hash = 0;
            for (const double x : key)
                hash = (hash ^ std::bit_cast<std::uint64_t>(x + 0.0))
                    * 0x9e3779b97f4a7c15u;  // + 0.0: -0 and 0 are equal
            return hash ^ (hash >> 32);
        }
    };
    std::unordered_map<Key, int, Hash> rows_;
    RowBuilder positions_;
};

/// Facet f has normal f, at all its corners.
Triangles facet_corners(Eigen::Index facets)
{
    return Eigen::VectorXi::LinSpaced(facets, 0, static_cast<int>(facets) - 1).replicate(1, 3);
}

std::string lower_case(std::string_view text)
{
    std::string lower(text);
    std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
    return lower;
}

class TextReader {
public:
    explicit TextReader(FileBytes file) { content_->file = std::move(file); }

    ContentPtr read()
    {
        const FileBytes& file = content_->file;
        for (Lines lines(file); lines.advance();) {
            Words words(file, lines.line());
            if (!words.done())
                read_line(lower_case(words.next_text()), words);
        }
        if (!at_end_)
            file.fail_at_line_of(file.bytes.size(),
                                 "the file ends without endsolid; it is truncated, export or copy it again");
        content_->format = "stl";
        content_->positions = weld_.positions();
        content_->normals = normals_.matrix();
        content_->triangles = fans_.triangles();
        content_->normal_corners = facet_corners(content_->triangles.rows());
        return content_;
    }

private:
    void read_line(const std::string& key, Words& words)
    {
        const FileBytes& file = content_->file;
        if (key == "facet") {
            if (!words.done())
                words.next();  // "normal"
            const Triple normal = next_triple(words, file);
            content_->places.push_back({ normal.span, normals_.rows(), true });
            normals_.add(normal.values);
        } else if (key == "vertex") {
            const Triple vertex = next_finite_triple(words, file);
            corners_.push_back(weld_.row_of(vertex.values));
            content_->places.push_back({ vertex.span, corners_.back(), false });
        } else if (key == "endfacet") {
            if (corners_.size() != 3 || ++facets_ != normals_.rows())
                file.fail_at_line_of(words.at(),
                                     "the facet has " + std::to_string(corners_.size())
                                         + " vertices; it needs three and a normal, export the file again");
            fans_.add(corners_);
            corners_.clear();
        } else if (key != "outer" && key != "endloop" && key != "solid" && key != "endsolid") {
            file.fail_at_line_of(words.at(), "unknown word in the STL file; export the file again");
        }
        at_end_ = key == "endsolid" && corners_.empty() && facets_ == normals_.rows();
    }

    std::shared_ptr<TextContent> content_ = std::make_shared<TextContent>();
    FacetWeld weld_;
    RowBuilder normals_;
    FanBuilder fans_;
    std::vector<int> corners_;  // of the facet being read
    Eigen::Index facets_ = 0;
    bool at_end_ = false;
};

constexpr std::size_t k_header_bytes = 84, k_facet_bytes = 50, k_triple_bytes = 12;  // literature: the format

static_assert(std::endian::native == std::endian::little,
              "binary STL and glTF are little-endian, and read as they are");

std::uint32_t facet_count(const FileBytes& file)
{
    std::uint32_t count = 0;
    if (file.bytes.size() >= k_header_bytes)
        std::memcpy(&count, file.bytes.data() + 80, sizeof count);
    return count;
}

Vec3 triple_at(const FileBytes& file, std::size_t offset)
{
    Eigen::Vector3f triple;
    std::memcpy(triple.data(), file.bytes.data() + offset, k_triple_bytes);
    return triple.cast<double>();
}

struct BinaryStlContent : MeshFile::Content {
    FileBytes file;
    Positions normals;

    double against_faces() const override
    {
        return share_against_faces(normals, facet_corners(triangles.rows()), triangles, positions);
    }

    std::string bytes_with(const Positions& moved) const override
    {
        const Positions turned = turn_normals(normals, facet_corners(triangles.rows()), triangles, positions, moved);
        std::string bytes = file.bytes;
        const auto put = [&](std::size_t offset, const Vec3& before, const Vec3& after) {
            const Eigen::Vector3f triple = after.cast<float>();
            if (before != after && before.allFinite())
                std::memcpy(bytes.data() + offset, triple.data(), k_triple_bytes);
        };
        for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
            const std::size_t facet = k_header_bytes + f * k_facet_bytes;
            put(facet, normals.row(f), turned.row(f));
            for (int k = 0; k < 3; ++k)
                put(facet + (1 + k) * k_triple_bytes, positions.row(triangles(f, k)), moved.row(triangles(f, k)));
        }
        return bytes;
    }
};

ContentPtr read_binary(FileBytes file)
{
    const std::uint32_t facets = facet_count(file);
    if (file.bytes.size() < k_header_bytes || (file.bytes.size() - k_header_bytes) / k_facet_bytes < facets
        || facets > INT_MAX / 3)
        file.fail_at_byte(file.bytes.size(),
                          "the file ends too soon for a binary STL file of " + std::to_string(facets)
                              + " facets; it is truncated or mangled, export or copy it again");
    auto content = std::make_shared<BinaryStlContent>();
    content->format = "stl";
    content->normals.resize(facets, 3);
    content->triangles.resize(facets, 3);
    FacetWeld weld;
    weld.expect_facets(facets);
    for (std::uint32_t f = 0; f < facets; ++f) {
        const std::size_t facet = k_header_bytes + f * k_facet_bytes;
        content->normals.row(f) = triple_at(file, facet);
        for (int k = 0; k < 3; ++k) {
            const std::size_t offset = facet + (1 + k) * k_triple_bytes;
            const Vec3 vertex = triple_at(file, offset);
            if (!vertex.allFinite())
                file.fail_at_byte(offset, "facet " + std::to_string(f) + " is not finite; repair the file",
                                  ErrorCode::not_finite);
            content->triangles(f, k) = weld.row_of(vertex);
        }
    }
    content->positions = weld.positions();
    content->file = std::move(file);
    return content;
}

}  // namespace

ContentPtr read_stl(FileBytes file)
{
    // many binary files begin with "solid" too; their size tells
    const bool is_binary = file.bytes.size() == k_header_bytes + k_facet_bytes * std::size_t(facet_count(file));
    const Span first_line { 0, std::min<std::size_t>(file.bytes.size(), 5) };
    if (!is_binary && lower_case(file.text(first_line)) == "solid")
        return TextReader(std::move(file)).read();
    return read_binary(std::move(file));
}

}  // namespace garmentfit
