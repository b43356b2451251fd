// SPDX-License-Identifier: GPL-3.0-or-later
#include "data_uri.h"

#include <algorithm>
#include <cstdint>

namespace garmentfit {
namespace {

constexpr std::string_view k_alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::string_view k_start = "data:", k_coding = ";base64,";

std::string decoded(std::string_view text)
{
    std::string bytes;
    std::uint32_t bits = 0;
    int count = 0;  // of bits that are not written yet
    for (const char letter : text)
        if (const std::size_t value = k_alphabet.find(letter); value != std::string_view::npos) {
            bits = bits << 6 | std::uint32_t(value);
            count += 6;
            if (count >= 8) {
                count -= 8;
                bytes += char(bits >> count & 0xFF);
            }
        }
    return bytes;
}

}  // namespace

std::string data_uri(std::string_view mime_type, std::string_view bytes)
{
    std::string uri = std::string(k_start) + std::string(mime_type) + std::string(k_coding);
    uri.reserve(uri.size() + bytes.size() * 4 / 3 + 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0);
        for (std::size_t k = 0; k < 4; ++k)
            uri += k <= count ? k_alphabet[bits >> (18 - 6 * k) & 63] : '=';
    }
    return uri;
}

std::optional<EmbeddedData> read_data_uri(std::string_view uri)
{
    const std::size_t coding = uri.find(k_coding);
    if (!uri.starts_with(k_start) || coding == std::string_view::npos)
        return {};
    return EmbeddedData { std::string(uri.substr(k_start.size(), coding - k_start.size())),
                          decoded(uri.substr(coding + k_coding.size())) };
}

}  // namespace garmentfit
