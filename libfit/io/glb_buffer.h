// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "garmentfit/types.h"
#include "gltf_container.h"

namespace garmentfit {

namespace gltf {
constexpr std::uint32_t k_binary_chunk = 0x004E4942;
constexpr int k_unsigned_byte = 5121, k_unsigned_int = 5125, k_float = 5126;  // component types
constexpr int k_array_buffer = 34962, k_element_array_buffer = 34963;  // targets
}  // namespace gltf

/// The binary buffer and the JSON that tells what lies where in it.
class GlbBuffer {
public:
    /// @param rows    one element each; of a SCALAR every entry is one
    /// @param target  0 for what is no vertex data
    /// @return the accessor's index
    template <class Number, class Matrix>
    int add(const Matrix& rows, int component, const char* type, int target)
    {
        const Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> values
            = rows.template cast<Number>();
        const std::size_t begin = bytes_.size(), size = std::size_t(values.size()) * sizeof(Number);
        bytes_.resize(begin + size);
        std::memcpy(bytes_.data() + begin, values.data(), size);
        nlohmann::ordered_json view { { "buffer", 0 }, { "byteOffset", begin }, { "byteLength", size } };
        if (target)
            view["target"] = target;
        views_.push_back(view);
        const std::size_t count
            = std::string(type) == "SCALAR" ? std::size_t(values.size()) : std::size_t(values.rows());
        accessors_.push_back({ { "bufferView", views_.size() - 1 },
                               { "componentType", component },
                               { "count", count },
                               { "type", type } });
        bytes_.resize((bytes_.size() + 3) / 4 * 4);
        return int(accessors_.size()) - 1;
    }

    /// The format wants them for positions and times.
    template <class Matrix>
    void set_bounds(int accessor, const Matrix& rows)
    {
        const Eigen::RowVectorXf least = rows.template cast<float>().colwise().minCoeff(),
                                 most = rows.template cast<float>().colwise().maxCoeff();
        accessors_[accessor]["min"] = std::vector<float>(least.begin(), least.end());
        accessors_[accessor]["max"] = std::vector<float>(most.begin(), most.end());
    }

    /// @param json  the rest of the file: scene, nodes, meshes, ...
    std::string file(nlohmann::ordered_json json) &&
    {
        json["buffers"] = { { { "byteLength", bytes_.size() } } };
        json["bufferViews"] = views_;
        json["accessors"] = accessors_;
        GltfContainer container;
        container.is_binary = true;
        container.json = std::move(json);
        container.chunks.push_back({ gltf::k_binary_chunk, std::move(bytes_) });
        return bytes_of(container);
    }

private:
    std::string bytes_;
    nlohmann::ordered_json views_ = nlohmann::ordered_json::array(), accessors_ = views_;
};

}  // namespace garmentfit
