// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/appearance.h"

#include <limits>

namespace garmentfit {

CornerUvs corner_uvs(const Appearance& look)
{
    constexpr double k_none = std::numeric_limits<double>::quiet_NaN();
    CornerUvs uvs = CornerUvs::Constant(look.uvs.rows() > 0 ? look.uv_corners.rows() : 0, 6, k_none);
    for (Eigen::Index f = 0; f < uvs.rows(); ++f)
        for (int k = 0; k < 3; ++k)
            if (const int row = look.uv_corners(f, k); row >= 0)
                uvs.row(f).segment<2>(2 * k) = look.uvs.row(row);
    return uvs;
}

}  // namespace garmentfit
