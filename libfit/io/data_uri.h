// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Data inside a URI, as glTF has buffers and pictures that lie in no file of their own (RFC 2397, base64: RFC 4648).

#include <optional>
#include <string>
#include <string_view>

namespace garmentfit {

struct EmbeddedData {
    std::string mime_type;
    std::string bytes;
};

std::string data_uri(std::string_view mime_type, std::string_view bytes);
/// None where the URI names a file. What is no letter of base64 is left out.
std::optional<EmbeddedData> read_data_uri(std::string_view uri);

}  // namespace garmentfit
