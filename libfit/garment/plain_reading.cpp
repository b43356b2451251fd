// SPDX-License-Identifier: GPL-3.0-or-later
#include "plain_reading.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <utility>
#include <vector>

#include "buckets.h"
#include "close_seams.h"
#include "cloth_patches.h"
#include "garment_openings.h"
#include "link_bridges.h"
#include "near_vertices.h"
#include "parallel.h"
#include "sewn_pieces.h"
#include "surface_measures.h"
#include "topology.h"
#include "tuning.h"

namespace garmentfit {
namespace {

using namespace garment_tuning;

std::array<int, 3> sorted_corners(const Triangles& triangles, Eigen::Index f)
{
    std::array<int, 3> key { triangles(f, 0), triangles(f, 1), triangles(f, 2) };
    std::sort(key.begin(), key.end());
    return key;
}

/// Drops degenerate faces and all but the first of equal faces, of either orientation.
Triangles drop_equal_faces(const Triangles& triangles, int vertices)
{
    std::vector<int> lowest(triangles.rows());
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        lowest[f] = triangles.row(f).minCoeff();
    const Buckets faces_at(vertices, lowest);
    std::vector<char> is_kept(triangles.rows());
    parallel_for(triangles.rows(), [&](Eigen::Index f) {
        const auto key = sorted_corners(triangles, f);
        const auto at = faces_at[key[0]];
        const bool is_first
            = *std::find_if(at.begin(), at.end(), [&](int g) { return sorted_corners(triangles, g) == key; }) == f;
        is_kept[f] = is_first && key[0] != key[1] && key[1] != key[2];
    });
    std::vector<Eigen::Index> rows;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        if (is_kept[f])
            rows.push_back(f);
    return triangles(rows, Eigen::all);
}

/// Without equal vertices, equal faces and degenerate faces.
GarmentMesh weld(const GarmentMesh& garment)
{
    TriangleMesh cloth = weld_vertices(garment);
    cloth.triangles = drop_equal_faces(cloth.triangles, int(cloth.positions.rows()));
    return { std::move(cloth.positions), std::move(cloth.triangles) };
}

MeshTopology topology_of(const GarmentMesh& cloth) { return { cloth.triangles, int(cloth.positions.rows()) }; }

/// Closes the gaps between panels that draping holds closed: a seam is no opening.
/// @param cloth  from weld
TriangleMesh close_gaps(GarmentMesh cloth)
{
    if (auto merged = merge_near_vertices(cloth, topology_of(cloth))) {
        cloth.positions = std::move(*merged);
        cloth = weld(cloth);
    }
    MeshTopology topology = topology_of(cloth);
    SewnPieces sewn = find_sewn_pieces(cloth, topology);
    if (bridge_links(cloth, topology, sewn.details)) {
        topology = topology_of(cloth);
        sewn = find_sewn_pieces(cloth, topology);
    }
    if (sewn.counts.seamed > 0) {
        TriangleMesh closed = close_seams({ cloth.positions, cloth.triangles }, topology, sewn.ties);
        cloth = weld({ std::move(closed.positions), std::move(closed.triangles) });
    }
    return { std::move(cloth.positions), std::move(cloth.triangles) };
}

/// Whether a large part of the cloth are panels of a pattern, each closed by its own thickness.
bool has_panels(const TriangleMesh& cloth, const std::vector<Patch>& patches)
{
    double all = 0, panels = 0;
    for (const Patch& patch : patches) {
        all += patch.area;
        if (is_closed_panel(patch, cloth))
            panels += patch.area;
    }
    return panels > k_panel_share * all;
}

/// Whether it has more border than openings have: panels that lie side by side, sheets beside each other, or holes.
bool has_many_borders(const TriangleMesh& cloth)
{
    const MeshTopology topology(cloth.triangles, int(cloth.positions.rows()));
    return border_length(cloth.positions, topology) > k_longest_borders * diagonal(cloth.positions);
}

/// Whether two borders are those of two sheets, which are joined elsewhere: one lies in the other, and no tube leads to
/// either, as at a cuff, where a sleeve of one sheet begins; or both are at the same place, and one faces where the
/// other comes from, as at a hem, where the sheets are joined at the neck.
bool are_rims_of_two_sheets(const Opening& one, const Opening& other)
{
    const double radius = std::min(one.girth, other.girth) / (2 * std::numbers::pi),
                 apart = (one.centre - other.centre).norm() / radius;
    const bool have_no_tube = std::max(one.tube_length, other.tube_length) < k_doubled_tube * radius,
               are_opposed = one.facing.dot(other.facing) < -k_opposed_facing;
    return (apart < k_doubled_rims && have_no_tube) || (apart < k_opposed_rims && are_opposed);
}

bool has_doubled_rims(const std::vector<Opening>& openings)
{
    for (std::size_t i = 0; i < openings.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (openings[i].piece == openings[j].piece && are_rims_of_two_sheets(openings[i], openings[j]))
                return true;
    return false;
}

/// Whether a border runs to and fro over the cloth, as where sheets that pass through each other are parted.
bool has_cracks(const std::vector<Opening>& openings, const TriangleMesh& outer)
{
    const double longest = k_longest_opening * diagonal(outer.positions);
    return std::any_of(openings.begin(), openings.end(), [&](const Opening& opening) {
        return opening.girth > longest && opening.roundness < k_roundest_crack;
    });
}

bool has_openings(const TriangleMesh& outer)
{
    const std::vector<Opening> openings = openings_of(outer);
    return openings.size() >= k_fewest_openings && !has_doubled_rims(openings) && !has_cracks(openings, outer);
}

}  // namespace

PlainReading read_plainly(GarmentMesh opened)
{
    PlainReading reading;
    reading.cloth = close_gaps(weld(opened));
    reading.opened = std::move(opened);
    const std::vector<Patch> patches = collect_patches(reading.cloth);
    const bool is_in_parts = has_panels(reading.cloth, patches) || has_many_borders(reading.cloth);
    orient_outwards(reading.cloth, patches);
    reading.outer = drop_inner_sheets(reading.cloth, patches);
    reading.is_sealed = is_sealed(reading.outer);
    reading.serves = !is_in_parts && (reading.is_sealed || has_openings(reading.outer));
    return reading;
}

}  // namespace garmentfit
