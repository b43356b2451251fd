// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Between numpy's arrays and matrices.

#include <memory>
#include <optional>
#include <utility>

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include "garmentfit/filters/scene_arrays.h"
#include "garmentfit/types.h"

namespace garmentfit::python {

namespace nb = nanobind;

/// Views of arrays that Python keeps alive during a call.
using NumbersIn = nb::ndarray<const double, nb::ndim<2>, nb::c_contig, nb::device::cpu>;
using IndicesIn = nb::ndarray<const int, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;

Rows rows_from(const NumbersIn& array);
/// @throws InvalidInput where it is not n x 3.
Positions positions_from(const NumbersIn& array);
/// @throws InvalidInput where it has rows that are not u0 v0 u1 v1 u2 v2.
CornerUvs corner_uvs_from(const NumbersIn& array);
Triangles triangles_from(const IndicesIn& array);

/// Moves the matrix to the heap; the numpy array owns it.
template <class Matrix>
auto array_of(Matrix matrix)
{
    constexpr int k_dimensions = Matrix::ColsAtCompileTime == 1 ? 1 : 2;
    auto kept = std::make_unique<Matrix>(std::move(matrix));
    Matrix& view = *kept;
    nb::capsule owner(kept.get(), [](void* p) noexcept { delete static_cast<Matrix*>(p); });
    static_cast<void>(kept.release());
    const size_t shape[2] = { size_t(view.rows()), size_t(view.cols()) };
    return nb::ndarray<nb::numpy, typename Matrix::Scalar, nb::ndim<k_dimensions>>(view.data(), k_dimensions, shape,
                                                                                   owner);
}

/// {"points": {name: array or list of texts}, "cells": ..., "field": ...}
nb::dict dict_of(const MeshArrays& arrays);
/// Finds arrays of float64 by a Python function: find(name) is an array or None. `find` may be None and must outlive
/// the result.
FindArray find_with(const nb::object& find);

}  // namespace garmentfit::python
