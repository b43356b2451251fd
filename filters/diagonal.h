// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "garmentfit/types.h"

namespace garmentfit {

/// Of the box round the vertices.
inline double diagonal_of(const Positions& positions)
{
    return (positions.colwise().maxCoeff() - positions.colwise().minCoeff()).norm();
}

}  // namespace garmentfit
