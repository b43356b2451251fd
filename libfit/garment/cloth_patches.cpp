// SPDX-License-Identifier: GPL-3.0-or-later
#include "cloth_patches.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>

#include "disjoint_sets.h"
#include "outer_sheet.h"
#include "panel.h"
#include "surface_measures.h"
#include "used_vertices.h"
#include "winding_number.h"

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
bool is_thick_cloth(const Patch& patch, const Triangles& triangles, double thickest)
{
    return thickness_of(patch) <= thickest * std::sqrt(patch.area)
        && euler_characteristic(patch, triangles).value_or(2) <= 0;
}

/// The faces of a patch, cut open along edges where it touches itself: those of more than two of its faces.
TriangleMesh cut_open(const Patch& patch, const TriangleMesh& cloth)
{
    const Triangles faces = cloth.triangles(patch.faces, Eigen::all);
    const std::vector<int> used = used_vertices(faces);
    const MeshTopology topology(numbered_among(used, faces), int(used.size()));
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

}  // namespace

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

std::vector<int> opposite_edges(const Triangles& triangles, int vertices)
{
    const MeshTopology topology(triangles, vertices);
    std::vector<int> opposite(3 * triangles.rows());
    for (int e = 0; e < int(opposite.size()); ++e)
        opposite[e] = topology.opposite(e);
    return opposite;
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

double thickness_of(const Patch& patch) { return thickness_of(patch.volume, patch.area); }

TriangleMesh drop_inner_sheets(const TriangleMesh& cloth, const std::vector<Patch>& patches, double thickest)
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

TriangleMesh fill_openings(TriangleMesh cloth)
{
    for (const std::vector<int>& loop : MeshTopology(cloth.triangles, int(cloth.positions.rows())).border_loops()) {
        const Eigen::RowVector3d middle = cloth.positions(loop, Eigen::all).colwise().mean();
        const Eigen::Index centre = cloth.positions.rows(), first = cloth.triangles.rows();
        cloth.positions.conservativeResize(centre + 1, 3);
        cloth.positions.row(centre) = middle;
        cloth.triangles.conservativeResize(first + Eigen::Index(loop.size()), 3);
        for (std::size_t i = 0; i < loop.size(); ++i)
            cloth.triangles.row(first + Eigen::Index(i)) << loop[(i + 1) % loop.size()], loop[i], int(centre);
    }
    return cloth;
}

double girth_of(const Positions& positions, const std::vector<int>& loop)
{
    double girth = 0;
    for (std::size_t i = 0; i < loop.size(); ++i)
        girth += (positions.row(loop[i]) - positions.row(loop[(i + 1) % loop.size()])).norm();
    return girth;
}

double border_length(const Positions& positions, const MeshTopology& topology)
{
    double length = 0;
    for (const int edge : topology.border_edges())
        length += (positions.row(topology.edges()(edge, 0)) - positions.row(topology.edges()(edge, 1))).norm();
    return length;
}

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

}  // namespace garmentfit
