// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The plain data of libfit.
//
// Units and axes: libfit works in metres with +y up, always. Hosts convert at the door (see garmentfit/units.h).
// Handedness: right. Triangles are counter-clockwise seen from outside.

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "garmentfit/version.h"

#if EIGEN_MAX_ALIGN_BYTES != 16 || (GARMENTFIT_X86_64_V3 && EIGEN_MALLOC_ALREADY_ALIGNED)
#error                                                                                                                 \
    "Eigen would free matrices of this program in another way than libfit makes them: link GarmentFit::fit in CMake, \
or define EIGEN_MAX_ALIGN_BYTES=16 and EIGEN_MALLOC_ALREADY_ALIGNED=0 for all sources"
#endif

namespace garmentfit {

using Vec3 = Eigen::Vector3d;

using Positions = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;  ///< n x 3, metres
using Triangles = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;  ///< m x 3, rows of Positions
/// Texture coordinates of the corners of triangles: rows u0 v0 u1 v1 u2 v2, not finite where a triangle has none.
using CornerUvs = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;  ///< m x 6, or no rows

struct TriangleMesh {
    Positions positions;
    Triangles triangles;
};

}  // namespace garmentfit
