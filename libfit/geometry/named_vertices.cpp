// SPDX-License-Identifier: GPL-3.0-or-later
#include "named_vertices.h"

#include <string>

#include "garmentfit/error.h"

namespace garmentfit {

void require_named_vertices(std::string_view what, Eigen::Index vertices, const Triangles& triangles)
{
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        if (triangles.row(f).minCoeff() < 0 || triangles.row(f).maxCoeff() >= vertices)
            throw InvalidInput(ErrorCode::bad_index,
                               std::string(what) + ": triangle " + std::to_string(f) + " refers to a vertex outside 0.."
                                   + std::to_string(vertices - 1) + "; repair the file");
}

}  // namespace garmentfit
