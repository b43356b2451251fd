// SPDX-License-Identifier: GPL-3.0-or-later
#include "numpy_arrays.h"

#include <string>

#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "garmentfit/error.h"

namespace garmentfit::python {
namespace {

nb::object object_of(const NamedArray& array)
{
    return std::visit(
        [](const auto& values) -> nb::object {
            if constexpr (std::is_same_v<std::decay_t<decltype(values)>, Texts>)
                return nb::cast(values);
            else
                return nb::cast(array_of(values));
        },
        array.values);
}

nb::dict dict_of(const std::vector<NamedArray>& arrays)
{
    nb::dict made;
    for (const NamedArray& array : arrays)
        made[array.name.c_str()] = object_of(array);
    return made;
}

}  // namespace

Rows rows_from(const NumbersIn& array)
{
    return Eigen::Map<const Rows>(array.data(), Eigen::Index(array.shape(0)), Eigen::Index(array.shape(1)));
}

Positions positions_from(const NumbersIn& array)
{
    if (array.shape(1) != 3)
        throw InvalidInput(ErrorCode::wrong_call,
                           "positions have " + std::to_string(array.shape(1)) + " columns; give an array of n x 3");
    return rows_from(array);
}

CornerUvs corner_uvs_from(const NumbersIn& array)
{
    if (array.shape(1) != 6)
        throw InvalidInput(ErrorCode::wrong_call,
                           "texture coordinates of corners have " + std::to_string(array.shape(1))
                               + " columns; give an array of m x 6");
    return rows_from(array);
}

Triangles triangles_from(const IndicesIn& array)
{
    return Eigen::Map<const Triangles>(array.data(), Eigen::Index(array.shape(0)), 3);
}

nb::dict dict_of(const MeshArrays& arrays)
{
    nb::dict made;
    made["points"] = dict_of(arrays.points);
    made["cells"] = dict_of(arrays.cells);
    made["field"] = dict_of(arrays.field);
    return made;
}

FindArray find_with(const nb::object& find)
{
    return [&find](const char* name) -> std::optional<Rows> {
        const nb::object array = find.is_none() ? find : find(name);
        if (array.is_none())
            return {};
        return rows_from(nb::cast<NumbersIn>(array));
    };
}

}  // namespace garmentfit::python
