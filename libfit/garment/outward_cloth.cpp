// SPDX-License-Identifier: GPL-3.0-or-later
#include "outward_cloth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "buckets.h"
#include "close_seams.h"
#include "disjoint_sets.h"
#include "garment_openings.h"
#include "garmentfit/closed_ends.h"
#include "kept_wraps.h"
#include "near_vertices.h"
#include "outer_sheet.h"
#include "panel.h"
#include "parallel.h"
#include "sewn_pieces.h"
#include "surface_measures.h"
#include "topology.h"
#include "tuning.h"
#include "winding_number.h"
#include "wrapped_surface.h"

namespace garmentfit {
namespace {

using namespace garment_tuning;

// unit: share of the diagonal, the precision of file formats; far below a stitch. The cells of a diagonal fit 21 bits
// an axis.
constexpr double k_weld_fraction = 1e-6;
constexpr double k_no_length = 1e-300;  // m, unit: avoids 0 / 0

/// Rotates the corners of each face so that the smallest index comes first.
Triangles start_at_lowest_corner(Triangles triangles)
{
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        Eigen::Index lowest = 0;
        triangles.row(f).minCoeff(&lowest);
        triangles.row(f)
            = Eigen::RowVector3i(triangles(f, lowest), triangles(f, (lowest + 1) % 3), triangles(f, (lowest + 2) % 3));
    }
    return triangles;
}

/// Merges equal vertices; the first vertex of each cell replaces the others. Drops vertices without a face.
TriangleMesh weld_vertices(const GarmentMesh& garment)
{
    const Vec3 low = garment.positions.colwise().minCoeff();
    const double diagonal = (Vec3(garment.positions.colwise().maxCoeff()) - low).norm();
    const double cell = std::max(k_weld_fraction * diagonal, k_no_length);
    const auto place
        = [&](int v, int axis) { return std::uint64_t(std::llround((garment.positions(v, axis) - low[axis]) / cell)); };

    std::vector<bool> used(garment.positions.rows(), false);
    for (const int v : garment.triangles.reshaped())
        used[v] = true;
    std::vector<std::pair<std::uint64_t, int>> places;
    for (int v = 0; v < int(used.size()); ++v)
        if (used[v])
            places.emplace_back(place(v, 0) << 42 | place(v, 1) << 21 | place(v, 2), v);
    std::sort(places.begin(), places.end());

    std::vector<int> first_of(garment.positions.rows(), -1);
    for (std::size_t i = 0; i < places.size(); ++i)
        first_of[places[i].second]
            = i > 0 && places[i].first == places[i - 1].first ? first_of[places[i - 1].second] : places[i].second;
    std::vector<int> row_of(garment.positions.rows(), -1), first;
    for (int v = 0; v < int(first_of.size()); ++v)
        if (first_of[v] == v) {
            row_of[v] = int(first.size());
            first.push_back(v);
        }
    return { garment.positions(first, Eigen::all),
             start_at_lowest_corner(garment.triangles.unaryExpr([&](int v) { return row_of[first_of[v]]; })) };
}

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
    const MeshTopology topology = topology_of(cloth);
    const SewnPieces sewn = find_sewn_pieces(cloth, topology);
    if (sewn.counts.seamed > 0) {
        TriangleMesh closed = close_seams({ cloth.positions, cloth.triangles }, topology, sewn.ties);
        cloth = weld({ std::move(closed.positions), std::move(closed.triangles) });
    }
    return { std::move(cloth.positions), std::move(cloth.triangles) };
}

/// Half-edge k of face f has number 3 f + k. The other half-edge between the same vertices; -1 if there is none or more
/// than one.
std::vector<int> opposite_edges(const Triangles& triangles, int vertices)
{
    const MeshTopology topology(triangles, vertices);
    std::vector<int> opposite(3 * triangles.rows());
    for (int e = 0; e < int(opposite.size()); ++e)
        opposite[e] = topology.opposite(e);
    return opposite;
}

/// Faces connected through edges of exactly two faces, oriented consistently with the first face.
struct Patch {
    std::vector<int> faces;
    std::vector<std::pair<int, int>> border;  // directed as in its faces
    double volume = 0, area = 0;  // m^3, each opening closed by a fan to its centroid; m^2
};

void flip(Triangles& triangles, int f) { std::swap(triangles(f, 1), triangles(f, 2)); }

/// Collects a patch and orients its faces. A flip renumbers the edges of a face, so faces are flipped at the end.
Patch collect_patch(int seed, Triangles& triangles, const std::vector<int>& opposite, std::vector<bool>& seen)
{
    Patch patch { { seed }, {}, 0, 0 };
    std::vector<bool> flipped { false };
    seen[seed] = true;
    for (std::size_t next = 0; next < patch.faces.size(); ++next)
        for (int k = 0; k < 3; ++k) {
            const int e = 3 * patch.faces[next] + k, other = opposite[e];
            const int a = triangles(e / 3, k), b = triangles(e / 3, (k + 1) % 3);
            if (other < 0) {
                patch.border.push_back(flipped[next] ? std::pair { b, a } : std::pair { a, b });
            } else if (!seen[other / 3]) {
                seen[other / 3] = true;
                patch.faces.push_back(other / 3);
                const bool runs_along = triangles(other / 3, other % 3) == a;
                flipped.push_back(runs_along != flipped[next]);
            }
        }
    for (std::size_t i = 0; i < patch.faces.size(); ++i)
        if (flipped[i])
            flip(triangles, patch.faces[i]);
    return patch;
}

/// Signed volume of the tetrahedron with the origin, m^3.
double tetrahedron(const Vec3& a, const Vec3& b, const Vec3& c) { return a.dot(b.cross(c)) / 6; }

void measure(Patch& patch, const TriangleMesh& cloth, DisjointSets& rings)
{
    const Vec3 origin = cloth.positions.row(cloth.triangles(patch.faces[0], 0));
    const auto at = [&](int v) { return Vec3(Vec3(cloth.positions.row(v)) - origin); };
    for (const int f : patch.faces) {
        patch.volume += tetrahedron(at(cloth.triangles(f, 0)), at(cloth.triangles(f, 1)), at(cloth.triangles(f, 2)));
        patch.area += area_vector(cloth.positions, cloth.triangles, f).norm();
    }
    for (const auto& [a, b] : patch.border)
        rings.join(a, b);
    std::vector<int> ring_of;
    for (const auto& [a, b] : patch.border)
        ring_of.push_back(rings.root(a));
    std::vector<int> roots = ring_of;
    std::sort(roots.begin(), roots.end());
    roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
    std::vector<Vec3> sums(roots.size(), Vec3::Zero());
    std::vector<int> counts(roots.size(), 0);
    const auto ring
        = [&](std::size_t i) { return std::lower_bound(roots.begin(), roots.end(), ring_of[i]) - roots.begin(); };
    for (std::size_t i = 0; i < patch.border.size(); ++i) {
        sums[ring(i)] += at(patch.border[i].first);
        ++counts[ring(i)];
    }
    for (std::size_t i = 0; i < patch.border.size(); ++i)
        patch.volume
            += tetrahedron(at(patch.border[i].second), at(patch.border[i].first), sums[ring(i)] / counts[ring(i)]);
}

Triangles rows_of(const Triangles& triangles, const std::vector<const Patch*>& patches)
{
    std::vector<int> rows;
    for (const Patch* patch : patches)
        rows.insert(rows.end(), patch->faces.begin(), patch->faces.end());
    return triangles(rows, Eigen::all);
}

/// Whether a patch that encloses nothing, such as a pocket, is oriented towards the interior of the rest of the
/// garment.
bool faces_inwards(const TriangleMesh& cloth, const Patch& patch, const WindingNumber& winding)
{
    double evidence = 0;  // m^2 times winding number
    for (const int f : patch.faces) {
        const Vec3 area = area_vector(cloth.positions, cloth.triangles, f);
        if (area.norm() == 0)
            continue;
        const Vec3 middle = cloth.positions(cloth.triangles.row(f), Eigen::all).colwise().mean();
        const Vec3 step = k_side_step * area.normalized();
        evidence += area.norm() * (winding(middle + step) - winding(middle - step));
    }
    return evidence > 0;
}

// ---- cloth with thickness ------------------------------------------------------------------------------------------

/// m, of a closed patch.
double thickness_of(const Patch& patch) { return garmentfit::thickness_of(patch.volume, patch.area); }

/// Number of edges with more than two faces, where the patch touches itself; empty if an edge is open.
std::optional<std::ptrdiff_t> count_touching_edges(const Patch& patch)
{
    std::map<std::pair<int, int>, int> balance;  // of directions of each edge, 0 if all cancel
    for (const auto& [a, b] : patch.border)
        balance[std::minmax(a, b)] += a < b ? 1 : -1;
    for (const auto& [edge, count] : balance)
        if (count != 0)
            return {};
    return std::ptrdiff_t(balance.size());
}

/// Of a closed patch, which may touch itself: 2 for a sphere, less by 2 for each tunnel. None if an edge is open.
std::optional<std::ptrdiff_t> euler_characteristic(const Patch& patch, const Triangles& triangles)
{
    const auto touched = count_touching_edges(patch);
    if (!touched)
        return {};
    std::set<int> vertices;
    for (const int f : patch.faces)
        for (int k = 0; k < 3; ++k)
            vertices.insert(triangles(f, k));
    const auto faces = std::ptrdiff_t(patch.faces.size());
    const auto edges = (3 * faces - std::ptrdiff_t(patch.border.size())) / 2 + *touched;
    return std::ptrdiff_t(vertices.size()) - edges + faces;
}

/// Whether a patch is closed, has tunnels, and has its two sheets no farther apart than padding, or `thickest`.
/// @param thickest  share of the root of the patch's area
bool is_thick_cloth(const Patch& patch, const Triangles& triangles, double thickest = k_thickest)
{
    return thickness_of(patch) <= thickest * std::sqrt(patch.area)
        && euler_characteristic(patch, triangles).value_or(2) <= 0;
}

std::vector<Patch> collect_patches(TriangleMesh& cloth)
{
    const int vertices = int(cloth.positions.rows());
    const std::vector<int> opposite = opposite_edges(cloth.triangles, vertices);
    std::vector<bool> seen(cloth.triangles.rows(), false);
    DisjointSets rings(vertices);
    std::vector<Patch> patches;
    for (int seed = 0; seed < int(seen.size()); ++seed)
        if (!seen[seed]) {
            patches.push_back(collect_patch(seed, cloth.triangles, opposite, seen));
            measure(patches.back(), cloth, rings);
        }
    return patches;
}

/// Keeps the outer sheets of cloth with thickness, so that a garment looks the same with and without thickness.
/// @param thickest  as in is_thick_cloth
TriangleMesh drop_inner_sheets(const TriangleMesh& cloth, const std::vector<Patch>& patches,
                               double thickest = k_thickest)
{
    if (std::none_of(patches.begin(), patches.end(),
                     [&](const Patch& patch) { return is_thick_cloth(patch, cloth.triangles, thickest); }))
        return cloth;
    const std::vector<int> opposite = opposite_edges(cloth.triangles, int(cloth.positions.rows()));
    std::vector<int> kept;
    for (const Patch& patch : patches) {
        const std::vector<int> faces = is_thick_cloth(patch, cloth.triangles, thickest)
            ? outer_sheet(cloth, patch.faces, opposite, thickness_of(patch))
            : patch.faces;
        kept.insert(kept.end(), faces.begin(), faces.end());
    }
    GarmentMesh outer;
    outer.positions = cloth.positions;
    outer.triangles = cloth.triangles(kept, Eigen::all);
    return weld_vertices(outer);
}

/// Patches that enclose a volume are oriented by its sign, flat ones by the winding number of the others.
void orient_outwards(TriangleMesh& cloth, const std::vector<Patch>& patches)
{
    const auto flip_all = [&](const Patch& patch) {
        for (const int f : patch.faces)
            flip(cloth.triangles, f);
    };
    std::vector<const Patch*> enclosing, flat;
    for (const Patch& patch : patches) {
        if (patch.volume < 0)
            flip_all(patch);
        const bool encloses = patch.border.empty() || std::abs(patch.volume) > k_flat_patch * std::pow(patch.area, 1.5);
        (encloses ? enclosing : flat).push_back(&patch);
    }
    if (enclosing.empty() || flat.empty())
        return;
    const WindingNumber winding({ cloth.positions, rows_of(cloth.triangles, enclosing) });
    for (const Patch* patch : flat)
        if (faces_inwards(cloth, *patch, winding))
            flip_all(*patch);
}

// ---- clothes in parts ----------------------------------------------------------------------------------------------

/// m
double border_length(const Positions& positions, const MeshTopology& topology)
{
    double length = 0;
    for (const int edge : topology.border_edges())
        length += (positions.row(topology.edges()(edge, 0)) - positions.row(topology.edges()(edge, 1))).norm();
    return length;
}

/// The faces of a patch, cut open along edges where it touches itself: those of more than two of its faces.
TriangleMesh cut_open(const Patch& patch, const TriangleMesh& cloth)
{
    const Triangles faces = cloth.triangles(patch.faces, Eigen::all);
    const MeshTopology topology(faces, int(cloth.positions.rows()));
    const auto next = [](int side) { return side / 3 * 3 + (side + 1) % 3; };
    const auto vertex = [&](int corner) { return faces(corner / 3, corner % 3); };
    DisjointSets corners { int(faces.size()) };
    for (int side = 0; side < int(faces.size()); ++side)
        if (const int other = topology.opposite(side); other >= 0)
            corners.join(side, vertex(other) == vertex(side) ? other : next(other));

    TriangleMesh cut { Positions(faces.size(), 3), Triangles(faces.rows(), 3) };
    std::vector<int> row_of(std::size_t(faces.size()), -1);
    int rows = 0;
    for (int corner = 0; corner < int(faces.size()); ++corner) {
        int& row = row_of[corners.root(corner)];
        if (row < 0) {
            row = rows++;
            cut.positions.row(row) = cloth.positions.row(vertex(corner));
        }
        cut.triangles(corner / 3, corner % 3) = row;
    }
    cut.positions.conservativeResize(rows, 3);
    return cut;
}

/// Whether a patch is closed as a sphere is, but for short slits along which it touches itself: panels that a program
/// for patterns sewed edge to edge touch along parts of their rims.
bool is_closed_panel(const Patch& patch, const TriangleMesh& cloth)
{
    if (!is_panel(thickness_of(patch), patch.area))
        return false;
    const TriangleMesh cut = cut_open(patch, cloth);
    const MeshTopology topology(cut.triangles, int(cut.positions.rows()));
    const auto characteristic = cut.positions.rows() - topology.edges().rows() + cut.triangles.rows();
    return characteristic + std::ptrdiff_t(topology.border_loops().size()) == 2
        && border_length(cut.positions, topology) < k_longest_slits * std::sqrt(patch.area);
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

/// A garment as it is read without a wrap.
struct PlainReading {
    GarmentMesh opened;  ///< as given without closed ends
    TriangleMesh cloth;  ///< without gaps between panels, each patch oriented outwards
    TriangleMesh outer;  ///< without the inner sheets of thick cloth
    bool serves;  ///< it is no garment in parts, and has openings or is a sealed one
};

/// A wrap round all parts, oriented outwards. It spans the gaps between them, but not the openings for a body.
struct Wrap {
    TriangleMesh surface;
    std::vector<Patch> patches;
};

Wrap wrap_parts(const PlainReading& plain)
{
    static KeptWraps kept;
    const auto make = [&] { return wrap_surface(plain.cloth, k_garment_wrap, k_garment_wrap_offset); };
    Wrap wrap { kept.of(plain.opened, make), {} };
    wrap.patches = collect_patches(wrap.surface);
    orient_outwards(wrap.surface, wrap.patches);
    return wrap;
}

/// Bridges what lies near to each other: sleeves and the trunk, legs.
TriangleMesh outer_sheet_of(const Wrap& wrap) { return drop_inner_sheets(wrap.surface, wrap.patches, INFINITY); }

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
TriangleMesh inner_sheet_of(const Wrap& wrap)
{
    const Patch& patch = *std::max_element(wrap.patches.begin(), wrap.patches.end(),
                                           [](const Patch& a, const Patch& b) { return a.area < b.area; });
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

constexpr std::size_t k_fewest_openings = 2;  // derived: a body enters through one and comes out at another

/// Both sheets of a wrap that a body can pass through.
struct Sheets {
    TriangleMesh outer, inner;
    std::size_t outer_openings = 0, inner_openings = 0;

    /// Whether the inner one is open where the body comes out: holes beside bridges make no sleeve or leg of the outer one.
    bool inner_goes_round() const { return inner_openings >= std::min(outer_openings, k_enough_openings); }
    /// In deep pleats the sheets change places, and both are ragged.
    bool inner_is_ragged() const
    {
        const MeshTopology topology(inner.triangles, int(inner.positions.rows()));
        return border_length(inner.positions, topology) > k_longest_sheet_borders * diagonal(inner.positions);
    }
};

/// None where the wrap closes the openings.
std::optional<Sheets> sheets_of(const Wrap& wrap)
{
    Sheets sheets { outer_sheet_of(wrap), inner_sheet_of(wrap) };
    sheets.outer_openings = count_openings(sheets.outer);
    sheets.inner_openings = count_openings(sheets.inner);
    if (sheets.outer_openings < k_fewest_openings)
        return {};
    return sheets;
}

PlainReading read_plainly(const GarmentMesh& garment)
{
    PlainReading reading { open_ends(garment).garment, {}, {}, false };
    reading.cloth = close_gaps(weld(reading.opened));
    const std::vector<Patch> patches = collect_patches(reading.cloth);
    const bool is_in_parts = has_panels(reading.cloth, patches) || has_many_borders(reading.cloth);
    orient_outwards(reading.cloth, patches);
    reading.outer = drop_inner_sheets(reading.cloth, patches);
    reading.serves = !is_in_parts && (is_sealed(reading.outer) || count_openings(reading.outer) >= k_fewest_openings);
    return reading;
}

}  // namespace

TriangleMesh outward_cloth(const GarmentMesh& garment)
{
    PlainReading plain = read_plainly(garment);
    if (plain.serves)
        return std::move(plain.outer);
    std::optional<Sheets> sheets = sheets_of(wrap_parts(plain));
    if (!sheets)
        return std::move(plain.outer);
    const bool reads_inner = sheets->inner_goes_round() && !sheets->inner_is_ragged();
    return reads_inner ? std::move(sheets->inner) : std::move(sheets->outer);
}

std::optional<GarmentMesh> lining_of(const GarmentMesh& garment, Lined lined)
{
    const PlainReading plain = read_plainly(garment);
    if (plain.serves && lined == Lined::clothes_in_parts)
        return {};
    std::optional<Sheets> sheets = sheets_of(wrap_parts(plain));
    if (!sheets || !sheets->inner_goes_round())
        return {};
    return GarmentMesh { std::move(sheets->inner.positions), std::move(sheets->inner.triangles) };
}

TriangleMesh rotate(TriangleMesh cloth, const Eigen::Quaterniond& turn)
{
    cloth.positions = (cloth.positions * turn.toRotationMatrix().transpose()).eval();
    return cloth;
}

}  // namespace garmentfit
