// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/appearance.h"

#include <limits>

namespace garmentfit {

CornerUvs corner_uvs(const Appearance::Uvs& uvs, const Triangles& rows)
{
    if (uvs.rows() == 0)
        return {};
    CornerUvs result = CornerUvs::Constant(rows.rows(), 6, std::numeric_limits<double>::quiet_NaN());
    for (Eigen::Index f = 0; f < rows.rows(); ++f)
        for (int k = 0; k < 3; ++k)
            if (const int row = rows(f, k); row >= 0)
                result.row(f).segment<2>(2 * k) = uvs.row(row);
    return result;
}

}  // namespace garmentfit
