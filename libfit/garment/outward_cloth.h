// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "garmentfit/mesh.h"

namespace garmentfit {

/// The garment prepared for analysis: equal vertices welded, equal faces dropped, inner sheets of thick cloth removed,
/// and every patch oriented outwards, independent of the orientation of the input. Cost O(n log n).
///
/// Where that leaves no garment, it is one sheet of an alpha wrap [portaneri_2022_alpha_wrap] round all of it, which takes
/// some seconds: of panels that are each closed by their thickness, of cloth with more border than openings have (sheets
/// side by side or beside each other), where only one opening is found, and where the rims of a cuff of two sheets lie in
/// each other. It is the inner sheet, which does not bridge the gaps between sleeves and trunk; the outer one where that
/// has openings which the inner one lacks.
TriangleMesh outward_cloth(const GarmentMesh& garment);

/// Which clothes get a lining: those that outward_cloth wraps, or all.
enum class Lined { clothes_in_parts, all };

struct Lining {
    GarmentMesh sheet;
    double gap;  ///< m, between it and the cloth around it
};

/// The inner sheet of such a wrap: one layer of cloth that goes round the body inside of all parts, facing outwards, in
/// one piece. None for what gets no lining, in O(n log n), and where it is closed where the wrap has openings. The cost of
/// a wrap.
std::optional<Lining> lining_of(const GarmentMesh& garment, Lined lined);

/// About the origin.
TriangleMesh rotate(TriangleMesh cloth, const Eigen::Quaterniond& turn);

}  // namespace garmentfit
