// SPDX-License-Identifier: GPL-3.0-or-later
#include "garment_wrap.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "garment_openings.h"
#include "kept_results.h"
#include "outer_sheet.h"
#include "surface_measures.h"
#include "tuning.h"
#include "wrapped_surface.h"

namespace garmentfit {
namespace {

using namespace garment_tuning;

/// Bridges what lies near to each other: sleeves and the trunk, legs.
TriangleMesh outer_sheet_of(const GarmentWrap& wrap) { return drop_inner_sheets(wrap.surface, wrap.patches, INFINITY); }

/// The largest connected part of some faces.
std::vector<int> largest_part(const std::vector<int>& faces, const std::vector<int>& opposite)
{
    std::vector<char> is_left(opposite.size() / 3, 0);
    for (const int f : faces)
        is_left[f] = 1;
    std::vector<int> largest;
    for (const int seed : faces) {
        if (!is_left[seed])
            continue;
        std::vector<int> part { seed };
        is_left[seed] = 0;
        for (std::size_t next = 0; next < part.size(); ++next)
            for (int k = 0; k < 3; ++k)
                if (const int other = opposite[3 * part[next] + k]; other >= 0 && is_left[other / 3]) {
                    is_left[other / 3] = 0;
                    part.push_back(other / 3);
                }
        if (part.size() > largest.size())
            largest = std::move(part);
    }
    return largest;
}

/// The other sheet of the largest patch, facing outwards, without what is cut off from its largest part.
TriangleMesh inner_sheet_of(const GarmentWrap& wrap)
{
    const Patch& patch = largest_patch(wrap);
    const std::vector<int> opposite = opposite_edges(wrap.surface.triangles, int(wrap.surface.positions.rows()));
    std::vector<char> is_outer(wrap.surface.triangles.rows(), 0);
    for (const int f : outer_sheet(wrap.surface, patch.faces, opposite, thickness_of(patch)))
        is_outer[f] = 1;
    std::vector<int> inner;
    std::copy_if(patch.faces.begin(), patch.faces.end(), std::back_inserter(inner),
                 [&](int f) { return !is_outer[f]; });
    GarmentMesh sheet;
    sheet.positions = wrap.surface.positions;
    sheet.triangles = wrap.surface.triangles(largest_part(inner, opposite), Eigen::all);
    sheet.triangles.col(1).swap(sheet.triangles.col(2));
    return weld_vertices(sheet);
}

TriangleMesh wrap_round(const TriangleMesh& cloth)
{
    return wrap_surface(cloth, k_garment_wrap, k_garment_wrap_offset);
}

GarmentWrap wrap_with(TriangleMesh surface)
{
    GarmentWrap wrap { std::move(surface), {} };
    wrap.patches = collect_patches(wrap.surface);
    orient_outwards(wrap.surface, wrap.patches);
    return wrap;
}

}  // namespace

GarmentWrap wrap_parts(const PlainReading& plain)
{
    static KeptResults<TriangleMesh> kept;
    return wrap_with(kept.of(plain.opened, [&] { return wrap_round(plain.cloth); }));
}

GarmentWrap wrap_closed(const PlainReading& plain) { return wrap_with(wrap_round(fill_openings(plain.cloth))); }

const Patch& largest_patch(const GarmentWrap& wrap)
{
    return *std::max_element(wrap.patches.begin(), wrap.patches.end(),
                             [](const Patch& a, const Patch& b) { return a.area < b.area; });
}

bool WrapSheets::inner_goes_round() const { return inner_openings >= std::min(outer_openings, k_enough_openings); }

bool WrapSheets::inner_is_ragged() const
{
    const MeshTopology topology(inner.triangles, int(inner.positions.rows()));
    return border_length(inner.positions, topology) > k_longest_sheet_borders * diagonal(inner.positions);
}

std::optional<WrapSheets> sheets_of(const GarmentWrap& wrap)
{
    WrapSheets sheets { outer_sheet_of(wrap), inner_sheet_of(wrap) };
    sheets.outer_openings = count_openings(sheets.outer);
    sheets.inner_openings = count_openings(sheets.inner);
    if (sheets.outer_openings < k_fewest_openings)
        return {};
    return sheets;
}

}  // namespace garmentfit
