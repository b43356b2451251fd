// SPDX-License-Identifier: GPL-3.0-or-later
#include "gltf_container.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>
#include <set>

#include "data_uri.h"
#include "garmentfit/error.h"

namespace garmentfit {
namespace {

using nlohmann::ordered_json;

// literature: glTF 2.0, sec. 4.4: "JSON", "BIN\0"
constexpr std::uint32_t k_json_type = 0x4E4F534A;
constexpr std::size_t k_header_bytes = 12, k_chunk_header_bytes = 8;  // literature: glTF 2.0, sec. 4.4
constexpr std::size_t k_most_padding = 3;  // literature: the same
constexpr int k_deepest_json = 100;  // unit: files of exporters stay below 20, and the parser recurses on the stack

static_assert(std::endian::native == std::endian::little, "glTF is little-endian, and read as it is");

std::uint32_t word_at(const FileBytes& file, std::size_t offset)
{
    std::uint32_t word = 0;
    std::memcpy(&word, file.bytes.data() + offset, sizeof word);
    return word;
}

std::string word_bytes(std::size_t value)
{
    const auto raw = std::bit_cast<std::array<char, 4>>(static_cast<std::uint32_t>(value));
    return { raw.begin(), raw.end() };
}

std::vector<GltfChunk> read_chunks(const FileBytes& file)
{
    if (file.bytes.size() < k_header_bytes)
        file.fail_at_byte(file.bytes.size(), "the GLB header is truncated; export or copy the file again");
    if (const std::uint32_t version = word_at(file, 4); version != 2)
        file.fail_at_byte(4, "is GLB version " + std::to_string(version) + "; export it as version 2");
    const std::size_t length = word_at(file, 8);
    if (length > file.bytes.size() || length < k_header_bytes)
        file.fail_at_byte(8,
                          "the GLB header says " + std::to_string(length) + " bytes, the file has "
                              + std::to_string(file.bytes.size())
                              + "; it is truncated or mangled, export or copy it again");
    std::vector<GltfChunk> chunks;
    for (std::size_t at = k_header_bytes; at < length;) {
        const std::size_t left = length - at;
        if (left < k_chunk_header_bytes || word_at(file, at) > left - k_chunk_header_bytes)
            file.fail_at_byte(
                at, "a chunk reaches beyond the end of the file; it is truncated or mangled, export or copy it again");
        const std::size_t size = word_at(file, at);
        chunks.push_back({ word_at(file, at + 4), file.bytes.substr(at + k_chunk_header_bytes, size) });
        at += k_chunk_header_bytes + size;
    }
    if (chunks.empty() || chunks.front().type != k_json_type)
        file.fail_at_byte(k_header_bytes, "the first chunk is not JSON; export the file again");
    return chunks;
}

ordered_json parse(const FileBytes& file, const std::string& text)
{
    const auto limit_depth = [&](int depth, ordered_json::parse_event_t, ordered_json&) {
        if (depth > k_deepest_json)
            file.fail("its JSON is nested more than " + std::to_string(k_deepest_json)
                      + " levels deep; export the file again");
        return true;
    };
    try {
        ordered_json json = ordered_json::parse(text, limit_depth);
        if (!json.is_object())
            file.fail("its JSON is not an object; export the file again as glTF 2.0");
        return json;
    } catch (const ordered_json::parse_error& error) {
        file.fail("its JSON is mangled or truncated at byte " + std::to_string(error.byte)
                  + " of the text; export or copy the file again");
    } catch (const ordered_json::out_of_range&) {
        file.fail("its JSON holds a number too large to read; export the file again");
    }
}

/// "%20" -> " ", as file names stand in URIs.
std::string decode(const std::string& uri)
{
    std::string text;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        unsigned char code = 0;
        if (uri[i] == '%' && i + 2 < uri.size()
            && std::from_chars(uri.data() + i + 1, uri.data() + i + 3, code, 16).ptr == uri.data() + i + 3) {
            text += static_cast<char>(code);
            i += 2;
        } else {
            text += uri[i];
        }
    }
    return text;
}

std::string pad(std::string bytes, char filler)
{
    bytes.resize((bytes.size() + 3) / 4 * 4, filler);
    return bytes;
}

// A PNG of one pixel each: (255, 255, 255), (128, 128, 255), (0, 0, 0).
constexpr const char *k_white_pixel
    = "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR42mP4//8/AAX+Av4zEpUUAAAAAElFTkSuQmCC",
    *k_flat_pixel = "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR42mNoaPgPAAODAgA+WCglAAAAAElFTkSuQmCC",
    *k_black_pixel = "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR42mNgYGAAAAAEAAHI6uv5AAAAAElFTkSuQmCC";

/// By the first bytes, as names may lie. What glTF does not know without an extension is for the program that wrote it.
std::string media_type(std::string_view bytes)
{
    if (bytes.starts_with("RIFF") && bytes.substr(0, 12).ends_with("WEBP"))
        return "image/webp";
    if (bytes.starts_with("\xABKTX 20"))
        return "image/ktx2";
    return bytes.starts_with("\x89PNG") ? "image/png" : "image/jpeg";
}

/// Rows of images that materials show under this name.
std::set<std::size_t> pictures_shown_as(const ordered_json& json, const char* name)
{
    std::set<std::size_t> pictures;
    for (const ordered_json& material : json.value("materials", ordered_json::array()))
        if (material.contains(name)) {
            const ordered_json& texture = json.at("textures").at(material[name].at("index").get<std::size_t>());
            pictures.insert(texture.value("source", std::size_t(-1)));
        }
    return pictures;
}

std::string chunk_bytes(std::uint32_t type, const std::string& bytes)
{
    return word_bytes(bytes.size()) + word_bytes(type) + bytes;
}

/// Some exporters say the length of the buffer before they put the last views into it. The chunk has them all.
void lengthen_own_buffer(GltfContainer& container)
{
    const std::string* const own = container.own_buffer();
    if (!own || !container.json.is_object() || !container.json.contains("buffers"))
        return;
    ordered_json& buffers = container.json["buffers"];
    if (!buffers.is_array() || buffers.empty() || !buffers[0].is_object() || buffers[0].contains("uri"))
        return;
    const auto length = buffers[0].find("byteLength");
    if (length != buffers[0].end() && length->is_number_unsigned()
        && length->get<std::size_t>() + k_most_padding < own->size())
        *length = own->size();
}

}  // namespace

std::string* GltfContainer::own_buffer()
{
    return chunks.empty() || chunks.front().type != k_binary_type ? nullptr : &chunks.front().bytes;
}

GltfContainer read_gltf_container(const FileBytes& file)
{
    GltfContainer container;
    container.is_binary = file.bytes.starts_with("glTF");
    if (container.is_binary) {
        container.chunks = read_chunks(file);
        container.json = parse(file, container.chunks.front().bytes);
        container.chunks.erase(container.chunks.begin());
        lengthen_own_buffer(container);
    } else {
        container.json = parse(file, file.bytes);
        const std::size_t line_break = file.bytes.find('\n');
        container.is_indented = line_break != std::string::npos && line_break + 1 < file.bytes.size();
    }
    return container;
}

std::string bytes_of(const GltfContainer& container)
{
    if (!container.is_binary)
        return container.json.dump(container.is_indented ? 2 : -1) + (container.is_indented ? "\n" : "");
    std::string chunks = chunk_bytes(k_json_type, pad(container.json.dump(), ' '));
    for (const GltfChunk& chunk : container.chunks)
        chunks += chunk_bytes(chunk.type, pad(chunk.bytes, '\0'));
    return "glTF" + word_bytes(2) + word_bytes(k_header_bytes + chunks.size()) + chunks;
}

std::string merge_buffers(const FileBytes& file, ordered_json& json, const std::vector<std::string>& buffers)
{
    std::string all;
    std::vector<std::size_t> begins;
    for (const std::string& bytes : buffers) {
        all = pad(std::move(all), '\0');
        begins.push_back(all.size());
        all += bytes;
    }
    if (json.contains("bufferViews"))
        for (ordered_json& view : json["bufferViews"]) {
            const std::size_t buffer = view.at("buffer");
            if (buffer >= begins.size())
                file.fail("a bufferView refers to buffer " + std::to_string(buffer)
                          + "; it is truncated or mangled, export or copy it again");
            view["byteOffset"] = begins[buffer] + view.value("byteOffset", std::size_t(0));
            view["buffer"] = 0;
        }
    json["buffers"] = ordered_json::array({ { { "byteLength", all.size() } } });
    return all;
}

std::string file_of_picture(const ordered_json& image)
{
    const std::string uri = image.is_object() && image.contains("uri") && image["uri"].is_string() ? image["uri"] : "";
    return uri.starts_with("data:") ? "" : decode(uri);
}

void embed_pictures(ordered_json& json, const std::filesystem::path& folder)
{
    if (!json.contains("images"))
        return;
    for (ordered_json& picture : json["images"]) {
        const std::string name = file_of_picture(picture);
        if (name.empty())
            continue;
        try {
            const FileBytes file = read_file(folder / name);
            picture["uri"] = data_uri(media_type(file.bytes), file.bytes);
        } catch (const InvalidInput&) {
            // the picture is missing; geometry does not need it
        }
    }
}

void fill_missing_pictures(ordered_json& json)
{
    if (!json.contains("images"))
        return;
    const std::set<std::size_t> normals = pictures_shown_as(json, "normalTexture"),
                                emissions = pictures_shown_as(json, "emissiveTexture");
    for (std::size_t i = 0; i < json["images"].size(); ++i) {
        ordered_json& picture = json["images"][i];
        if (!file_of_picture(picture).empty())
            picture["uri"] = std::string("data:image/png;base64,")
                + (normals.count(i)         ? k_flat_pixel
                       : emissions.count(i) ? k_black_pixel
                                            : k_white_pixel);
    }
}

}  // namespace garmentfit
