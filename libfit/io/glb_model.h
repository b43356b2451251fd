// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A glTF model that is made to be written as GLB: tinygltf's, with one binary buffer that grows.

#include <cstdint>
#include <string>
#include <type_traits>

#include "garmentfit/types.h"
#include "tinygltf.h"

namespace garmentfit {

class GlbModel {
public:
    GlbModel();

    /// Appends values of one kind to the buffer.
    /// @tparam Number  float, std::uint8_t, std::uint16_t or std::uint32_t: how they are stored
    /// @param rows     one element each; of TINYGLTF_TYPE_SCALAR every entry is one
    /// @param target   0 for what is no vertex data
    /// @return the accessor's index
    template <class Number, class Matrix>
    int add(const Matrix& rows, int type, int target = 0)
    {
        const Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> values
            = rows.template cast<Number>();
        const std::size_t count = std::size_t(type == TINYGLTF_TYPE_SCALAR ? values.size() : values.rows());
        return add_bytes(values.data(), std::size_t(values.size()) * sizeof(Number), component_of<Number>(), count,
                         type, target);
    }

    /// Least and largest of each column, as they are stored. The format wants them for positions and times.
    template <class Matrix>
    void set_bounds(int accessor, const Matrix& rows)
    {
        const Eigen::RowVectorXf least = rows.template cast<float>().colwise().minCoeff(),
                                 most = rows.template cast<float>().colwise().maxCoeff();
        model.accessors[accessor].minValues.assign(least.begin(), least.end());
        model.accessors[accessor].maxValues.assign(most.begin(), most.end());
    }

    /// Appends bytes of any kind. @return the buffer view's index
    int add_view(const void* bytes, std::size_t size, int target = 0);

    /// The bytes of the GLB file.
    std::string file() const;

    tinygltf::Model model;  ///< the rest is filled in by the writer: nodes, meshes, ...

private:
    template <class Number>
    static constexpr int component_of()
    {
        if constexpr (std::is_same_v<Number, float>)
            return TINYGLTF_COMPONENT_TYPE_FLOAT;
        else if constexpr (std::is_same_v<Number, std::uint32_t>)
            return TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
        else if constexpr (std::is_same_v<Number, std::uint16_t>)
            return TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
        else if constexpr (std::is_same_v<Number, std::uint8_t>)
            return TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
    }
    int add_bytes(const void* bytes, std::size_t size, int component, std::size_t count, int type, int target);
};

}  // namespace garmentfit
