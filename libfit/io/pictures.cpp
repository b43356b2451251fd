// SPDX-License-Identifier: GPL-3.0-or-later
#include "pictures.h"

#include <algorithm>

namespace garmentfit {
namespace {

constexpr int k_largest_side = 8192;  // literature: what WebGL 2 programs can rely on most graphics cards to show

int big_endian(std::string_view bytes, std::size_t at, std::size_t count)
{
    int value = 0;
    for (std::size_t i = 0; i < count; ++i)
        value = value * 256 + static_cast<unsigned char>(bytes[at + i]);
    return value;
}

/// JPEG: the frame header, after segments of which each says its length.
std::pair<int, int> jpeg_size(std::string_view bytes)
{
    for (std::size_t at = 2; at + 9 < bytes.size() && bytes[at] == '\xFF';) {
        const auto kind = static_cast<unsigned char>(bytes[at + 1]);
        const bool is_frame = kind >= 0xC0 && kind <= 0xCF && kind != 0xC4 && kind != 0xC8 && kind != 0xCC;
        if (is_frame)
            return { big_endian(bytes, at + 7, 2), big_endian(bytes, at + 5, 2) };
        at += 2 + std::size_t(std::max(2, big_endian(bytes, at + 2, 2)));
    }
    return { 0, 0 };
}

}  // namespace

std::string picture_type(std::string_view bytes)
{
    if (bytes.starts_with("\x89PNG\r\n\x1a\n"))
        return "image/png";
    return bytes.starts_with("\xFF\xD8\xFF") ? "image/jpeg" : "";
}

std::pair<int, int> picture_size(std::string_view bytes)
{
    const std::string type = picture_type(bytes);
    if (type == "image/png" && bytes.size() >= 24)
        return { big_endian(bytes, 16, 4), big_endian(bytes, 20, 4) };
    return type == "image/jpeg" ? jpeg_size(bytes) : std::pair(0, 0);
}

std::string warning_of_size(const std::string& name, std::string_view bytes)
{
    const auto [width, height] = picture_size(bytes);
    return std::max(width, height) <= k_largest_side
        ? ""
        : "texture " + name + " has " + std::to_string(width) + " x " + std::to_string(height)
            + " pixels, which some programs cannot show; scale it down to " + std::to_string(k_largest_side);
}

int add_picture(Appearance& look, const std::string& name, std::string bytes)
{
    const std::string type = picture_type(bytes);
    if (type.empty()) {
        look.warnings.push_back("texture " + name + " is neither PNG nor JPEG and is left out; convert it");
        return -1;
    }
    look.pictures.push_back({ name, type, std::move(bytes) });
    return int(look.pictures.size()) - 1;
}

}  // namespace garmentfit
