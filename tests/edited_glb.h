// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// GLB files with other JSON, as other programs write them.

#include <cstdint>
#include <cstring>
#include <functional>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace garmentfit::fixtures {

inline std::uint32_t number_in(const std::string& bytes, std::size_t at)
{
    std::uint32_t number;
    std::memcpy(&number, bytes.data() + at, sizeof number);
    return number;
}

/// A GLB whose JSON is changed; its buffer stays.
inline std::string edited(const std::string& glb, const std::function<void(nlohmann::json&)>& edit)
{
    const std::size_t size = number_in(glb, 12);
    nlohmann::json document = nlohmann::json::parse(glb.substr(20, size));
    edit(document);
    std::string text = document.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::string rest = glb.substr(20 + size);
    const auto bytes_of = [](std::size_t number) {
        const auto n = std::uint32_t(number);
        return std::string(reinterpret_cast<const char*>(&n), sizeof n);
    };
    return glb.substr(0, 8) + bytes_of(20 + text.size() + rest.size()) + bytes_of(text.size()) + "JSON" + text + rest;
}

inline int node_called(const nlohmann::json& document, const std::string& name)
{
    for (std::size_t n = 0; n < document["nodes"].size(); ++n)
        if (document["nodes"][n].value("name", "") == name)
            return int(n);
    ADD_FAILURE() << name;
    return 0;
}

}  // namespace garmentfit::fixtures
