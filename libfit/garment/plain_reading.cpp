// SPDX-License-Identifier: GPL-3.0-or-later
#include "plain_reading.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "buckets.h"
#include "close_seams.h"
#include "cloth_patches.h"
#include "garment_openings.h"
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

/// A side of a triangle on a border, in its direction.
struct BorderSide {
    int from, to;
    Vec3 middle;
};

std::vector<BorderSide> borders_at(const std::vector<int>& vertices, const GarmentMesh& cloth,
                                   const MeshTopology& topology)
{
    const auto is_among = [&](int v) { return std::binary_search(vertices.begin(), vertices.end(), v); };
    std::vector<BorderSide> sides;
    for (const int edge : topology.border_edges()) {
        const int side = topology.sides_at(edge)[0], from = cloth.triangles(side / 3, side % 3),
                  to = cloth.triangles(side / 3, (side % 3 + 1) % 3);
        if (is_among(from) || is_among(to))
            sides.push_back({ from, to, 0.5 * (cloth.positions.row(from) + cloth.positions.row(to)).transpose() });
    }
    return sides;
}

/// m, along a border from one of its vertices to another; none where they are on no common border.
std::optional<double> way_along_border(const GarmentMesh& cloth, const std::vector<std::vector<int>>& loops, int from,
                                       int to)
{
    for (const std::vector<int>& loop : loops) {
        const auto start = std::find(loop.begin(), loop.end(), from);
        if (start == loop.end() || std::find(loop.begin(), loop.end(), to) == loop.end())
            continue;
        double way = 0;
        for (std::size_t i = std::size_t(start - loop.begin()); loop[i % loop.size()] != to; ++i)
            way += (cloth.positions.row(loop[(i + 1) % loop.size()]) - cloth.positions.row(loop[i % loop.size()]))
                       .norm();
        return way;
    }
    return {};
}

/// Two triangles between the nearest border edges of two parts that a ring joins: a strap goes on into the bodice, and
/// parts the armhole from the neck. Not where they would part a small hole from the border, as a belt's end in its
/// buckle does. @return whether there were any
bool bridge_links(GarmentMesh& cloth, const MeshTopology& topology, const std::vector<SewnDetail>& details)
{
    const std::vector<std::vector<int>> loops = topology.border_loops();
    const double shortest = k_strap_border * diagonal(cloth.positions);
    std::vector<Eigen::RowVector3i> bridges;
    for (const SewnDetail& detail : details) {
        std::optional<std::pair<BorderSide, BorderSide>> nearest;
        double least = INFINITY;
        for (const BorderSide& one : borders_at(detail.linked[0], cloth, topology))
            for (const BorderSide& other : borders_at(detail.linked[1], cloth, topology))
                if (const double apart = (one.middle - other.middle).norm(); apart < least) {
                    least = apart;
                    nearest = { one, other };
                }
        if (!nearest)
            continue;
        const auto& [a, b] = *nearest;
        const std::optional<double> one_way = way_along_border(cloth, loops, a.to, b.from),
                                    other_way = way_along_border(cloth, loops, b.to, a.from);
        if (one_way && other_way && std::min(*one_way, *other_way) > shortest) {
            bridges.push_back({ a.to, a.from, b.to });
            bridges.push_back({ a.to, b.to, b.from });
        }
    }
    const Eigen::Index first = cloth.triangles.rows();
    cloth.triangles.conservativeResize(first + Eigen::Index(bridges.size()), 3);
    for (std::size_t i = 0; i < bridges.size(); ++i)
        cloth.triangles.row(first + Eigen::Index(i)) = bridges[i];
    return !bridges.empty();
}

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
