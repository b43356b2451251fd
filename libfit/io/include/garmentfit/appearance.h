// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// UVs, materials and pictures of a mesh file, for files of another format. MeshFile::write needs none of this: it keeps
// what was read as it was.

#include <string>
#include <vector>

#include "garmentfit/export.h"
#include "garmentfit/types.h"

namespace garmentfit {

/// A PNG or JPEG as it was in its file.
struct Picture {
    std::string name, mime_type, bytes;
};

/// The metallic-roughness model of glTF. Pictures are rows of Appearance::pictures, -1: none.
struct SurfaceMaterial {
    std::string name;
    Eigen::Vector4d colour { 1, 1, 1, 1 };  ///< linear; the last is opacity
    double metallic = 0, roughness = 1;
    Eigen::Vector3d emission { 0, 0, 0 };
    std::string alpha = "OPAQUE";  ///< or "MASK" or "BLEND"
    double alpha_cutoff = 0.5, normal_scale = 1;
    bool is_double_sided = true;
    int colour_picture = -1, roughness_picture = -1, normal_picture = -1, occlusion_picture = -1, emission_picture = -1;
};

struct Appearance {
    using Uvs = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

    std::vector<Picture> pictures;
    std::vector<SurfaceMaterial> materials;
    std::vector<int> material_of;  ///< of each triangle of the file, -1: none. Empty: no triangle has one
    Uvs uvs;  ///< v grows downwards, as in glTF
    Triangles uv_corners;  ///< rows of uvs for each corner of the triangles, -1: none. Without rows: no UVs
    std::vector<std::string> warnings;  ///< of what could not be kept, in whole sentences
};

/// UVs of all corners of triangles; no rows where there are none. O(n).
/// @param rows  of uvs for each corner, -1: none
GARMENTFIT_API CornerUvs corner_uvs(const Appearance::Uvs& uvs, const Triangles& rows);

}  // namespace garmentfit
