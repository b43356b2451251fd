// SPDX-License-Identifier: GPL-3.0-or-later
#include "outward_cloth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "buckets.h"
#include "joined_vertices.h"
#include "nearest.h"
#include "parallel.h"
#include "winding_number.h"

namespace fit {
namespace {

constexpr double k_weld_fraction = 1e-6;  // of the diagonal: what file formats round away, far below a stitch
constexpr double k_flat_patch = 0.01;  // volume / area^1.5; a sphere has 0.094, a sleeve 0.03, a pocket 0.002
constexpr double k_thickest = 0.02;  // m between the sheets of cloth that has two
constexpr double k_backing = 3;  // thicknesses; along a rim it is further to the next cloth
constexpr double k_back = 0.5;  // cosine; less, and what lies behind a face is not the other sheet
constexpr double k_fold = -0.2;  // cosine of the angle between two faces; sharper, and they belong to two sheets
constexpr double k_side_step = 0.02;  // m; how far a flat patch looks to either side of itself

// Turned round to begin with their lowest corner: the same face, however it was written.
Triangles begun_at_lowest(Triangles triangles)
{
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        Eigen::Index lowest = 0;
        triangles.row(f).minCoeff(&lowest);
        triangles.row(f)
            = Eigen::RowVector3i(triangles(f, lowest), triangles(f, (lowest + 1) % 3), triangles(f, (lowest + 2) % 3));
    }
    return triangles;
}

// Equal vertices become one; vertices without a face are left behind.
TriangleMesh welded(const GarmentMesh& garment)
{
    const Vec3 low = garment.positions.colwise().minCoeff();
    const double diagonal = (Vec3(garment.positions.colwise().maxCoeff()) - low).norm();
    const double cell = std::max(k_weld_fraction * diagonal, 1e-300);
    const auto place
        = [&](int v, int axis) { return std::uint64_t(std::llround((garment.positions(v, axis) - low[axis]) / cell)); };

    std::vector<bool> used(garment.positions.rows(), false);
    for (const int v : garment.triangles.reshaped())
        used[v] = true;
    std::vector<std::pair<std::uint64_t, int>> places;  // 1e6 cells along the diagonal: 21 bits an axis
    for (int v = 0; v < int(used.size()); ++v)
        if (used[v])
            places.emplace_back(place(v, 0) << 42 | place(v, 1) << 21 | place(v, 2), v);
    std::sort(places.begin(), places.end());

    std::vector<int> first_of(garment.positions.rows(), -1);  // the first vertex of each place stands for all
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
             begun_at_lowest(garment.triangles.unaryExpr([&](int v) { return row_of[first_of[v]]; })) };
}

std::array<int, 3> sorted_corners(const Triangles& triangles, Eigen::Index f)
{
    std::array<int, 3> key { triangles(f, 0), triangles(f, 1), triangles(f, 2) };
    std::sort(key.begin(), key.end());
    return key;
}

Triangles distinct_faces(const Triangles& triangles, int vertices)
{
    std::vector<int> lowest(triangles.rows());
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        lowest[f] = triangles.row(f).minCoeff();
    const Buckets faces_at(vertices, lowest);
    std::vector<Eigen::Index> rows;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        const auto key = sorted_corners(triangles, f);
        const auto at = faces_at[key[0]];
        const bool is_first
            = *std::find_if(at.begin(), at.end(), [&](int g) { return sorted_corners(triangles, g) == key; }) == f;
        if (is_first && key[0] != key[1] && key[1] != key[2])
            rows.push_back(f);
    }
    return triangles(rows, Eigen::all);
}

// Edge k of face f is 3 f + k. The other edge between the same vertices; -1 where there is none or more than one.
std::vector<int> opposite_edges(const Triangles& triangles, int vertices)
{
    const auto from = [&](int e) { return triangles(e / 3, e % 3); };
    const auto to = [&](int e) { return triangles(e / 3, (e % 3 + 1) % 3); };
    std::vector<int> lowest(3 * triangles.rows());
    for (int e = 0; e < int(lowest.size()); ++e)
        lowest[e] = std::min(from(e), to(e));
    const Buckets edges_at(vertices, lowest);
    std::vector<int> opposite(lowest.size(), -1);
    for (int e = 0; e < int(lowest.size()); ++e) {
        int found = -1, count = 0;
        for (const int other : edges_at[lowest[e]])
            if (other != e && std::max(from(other), to(other)) == std::max(from(e), to(e))) {
                found = other;
                ++count;
            }
        opposite[e] = count == 1 ? found : -1;
    }
    return opposite;
}

// Faces that hang together through edges of exactly two faces, all turned to agree with the first.
struct Patch {
    std::vector<int> faces;
    std::vector<std::pair<int, int>> border;  // directed as its faces are
    double volume = 0, area = 0;  // volume with each opening closed by a fan to the opening's middle
};

Vec3 area_vector(const Positions& p, const Triangles& t, Eigen::Index f)
{
    const Vec3 a = p.row(t(f, 0)), b = p.row(t(f, 1)), c = p.row(t(f, 2));
    return 0.5 * (b - a).cross(c - a);
}

void turn(Triangles& triangles, int f) { std::swap(triangles(f, 1), triangles(f, 2)); }

// Turning a face renames its edges, so faces are turned when all of the patch is known.
Patch patch_from(int seed, Triangles& triangles, const std::vector<int>& opposite, std::vector<bool>& seen)
{
    Patch patch { { seed }, {}, 0, 0 };
    std::vector<bool> turned { false };
    seen[seed] = true;
    for (std::size_t next = 0; next < patch.faces.size(); ++next)
        for (int k = 0; k < 3; ++k) {
            const int e = 3 * patch.faces[next] + k, other = opposite[e];
            const int a = triangles(e / 3, k), b = triangles(e / 3, (k + 1) % 3);
            if (other < 0) {
                patch.border.push_back(turned[next] ? std::pair { b, a } : std::pair { a, b });
            } else if (!seen[other / 3]) {
                seen[other / 3] = true;
                patch.faces.push_back(other / 3);
                const bool runs_along = triangles(other / 3, other % 3) == a;
                turned.push_back(runs_along != turned[next]);
            }
        }
    for (std::size_t i = 0; i < patch.faces.size(); ++i)
        if (turned[i])
            turn(triangles, patch.faces[i]);
    return patch;
}

double tetrahedron(const Vec3& a, const Vec3& b, const Vec3& c) { return a.dot(b.cross(c)) / 6; }

void measure(Patch& patch, const TriangleMesh& cloth, JoinedVertices& rings)
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

// A pocket encloses nothing itself: it faces away from what the rest of the garment encloses.
bool faces_inwards(const TriangleMesh& cloth, const Patch& patch, const WindingNumber& winding)
{
    double vote = 0;
    for (const int f : patch.faces) {
        const Vec3 area = area_vector(cloth.positions, cloth.triangles, f);
        if (area.norm() == 0)
            continue;
        const Vec3 middle = cloth.positions(cloth.triangles.row(f), Eigen::all).colwise().mean();
        const Vec3 step = k_side_step * area.normalized();
        vote += area.norm() * (winding(middle + step) - winding(middle - step));
    }
    return vote > 0;
}

// ---- cloth with thickness ------------------------------------------------------------------------------------------

// Closed all round, but for tunnels, with no more between its two sheets than padding.
bool is_thick_cloth(const Patch& patch, const Triangles& triangles)
{
    std::set<int> vertices;
    for (const int f : patch.faces)
        for (int k = 0; k < 3; ++k)
            vertices.insert(triangles(f, k));
    const auto faces = std::ptrdiff_t(patch.faces.size());
    const bool has_tunnels
        = std::ptrdiff_t(vertices.size()) - faces / 2 <= 0;  // Euler; each face has one and a half edges
    return patch.border.empty() && has_tunnels && 2 * std::abs(patch.volume) < k_thickest * patch.area;
}

// Which of its faces have the other sheet close behind them; the others are rims.
std::vector<char> backed_faces(const TriangleMesh& cloth, const Patch& patch)
{
    const double thickness = 2 * std::abs(patch.volume) / patch.area;
    const TriangleTree tree({ cloth.positions, cloth.triangles(patch.faces, Eigen::all) });
    std::vector<char> backed(std::size_t(cloth.triangles.rows()), 0);
    parallel_for<std::size_t>(
        patch.faces.size(),
        [&](std::size_t i) {
            const int f = patch.faces[i];
            const Vec3 area = area_vector(cloth.positions, cloth.triangles, f);
            if (area.norm() == 0)
                return;
            const Vec3 inwards = -area.normalized();
            const Vec3 middle = cloth.positions(cloth.triangles.row(f), Eigen::all).colwise().mean();
            const auto hit = tree.first_hit(middle + 1e-3 * thickness * inwards, inwards);
            backed[f] = hit && hit->distance < k_backing * thickness && hit->cosine > k_back;
        },
        256);
    return backed;
}

// Parts of it that hang together without rims and folds. What is turned towards the body encloses less than nothing.
std::vector<Patch> sheets_of(const TriangleMesh& cloth, const Patch& patch)
{
    const std::vector<char> backed = backed_faces(cloth, patch);
    const std::vector<int> opposite = opposite_edges(cloth.triangles, int(cloth.positions.rows()));
    const auto normal = [&](int f) { return area_vector(cloth.positions, cloth.triangles, f).normalized(); };
    const auto next_to = [&](int e) {  // the face beyond an edge, -1 where the sheet ends
        const int other = opposite[e] < 0 ? -1 : opposite[e] / 3;
        return other >= 0 && backed[other] && normal(e / 3).dot(normal(other)) > k_fold ? other : -1;
    };
    std::vector<char> seen(backed.size(), 0);
    JoinedVertices rings(int(cloth.positions.rows()));
    std::vector<Patch> sheets;
    for (const int seed : patch.faces) {
        if (!backed[seed] || seen[seed])
            continue;
        Patch sheet { { seed }, {}, 0, 0 };
        seen[seed] = 1;
        for (std::size_t next = 0; next < sheet.faces.size(); ++next)
            for (int k = 0; k < 3; ++k) {
                const int f = sheet.faces[next], other = next_to(3 * f + k);
                if (other < 0)
                    sheet.border.emplace_back(cloth.triangles(f, k), cloth.triangles(f, (k + 1) % 3));
                else if (!std::exchange(seen[other], 1))
                    sheet.faces.push_back(other);
            }
        measure(sheet, cloth, rings);
        sheets.push_back(std::move(sheet));
    }
    return sheets;
}

// Cloth with thickness has two sheets, and only the outer one is what a garment looks like without.
TriangleMesh without_inner_sheets(const TriangleMesh& cloth, const std::vector<Patch>& patches)
{
    std::vector<int> kept;
    const auto keep = [&](const Patch& patch) { kept.insert(kept.end(), patch.faces.begin(), patch.faces.end()); };
    for (const Patch& patch : patches) {
        const bool thick = is_thick_cloth(patch, cloth.triangles);
        const std::vector<Patch> sheets = thick ? sheets_of(cloth, patch) : std::vector<Patch> { patch };
        for (const Patch& sheet : sheets)
            if (!thick || sheet.volume > 0)
                keep(sheet);
    }
    if (kept.empty() || kept.size() == std::size_t(cloth.triangles.rows()))
        return cloth;
    GarmentMesh outer;
    outer.positions = cloth.positions;
    outer.triangles = cloth.triangles(kept, Eigen::all);
    return welded(outer);
}

}  // namespace

TriangleMesh outward_cloth(const GarmentMesh& garment)
{
    TriangleMesh cloth = welded(garment);
    const int vertices = int(cloth.positions.rows());
    cloth.triangles = distinct_faces(cloth.triangles, vertices);
    const std::vector<int> opposite = opposite_edges(cloth.triangles, vertices);
    std::vector<bool> seen(cloth.triangles.rows(), false);
    JoinedVertices rings(vertices);
    std::vector<Patch> patches;
    for (int seed = 0; seed < int(seen.size()); ++seed)
        if (!seen[seed]) {
            patches.push_back(patch_from(seed, cloth.triangles, opposite, seen));
            measure(patches.back(), cloth, rings);
        }

    std::vector<const Patch*> outward, flat;
    for (const Patch& patch : patches) {
        if (patch.volume < 0)
            for (const int f : patch.faces)
                turn(cloth.triangles, f);
        const bool is_sure
            = patch.border.empty() || std::abs(patch.volume) > k_flat_patch * std::pow(patch.area, 1.5);
        (is_sure ? outward : flat).push_back(&patch);
    }
    if (!outward.empty() && !flat.empty()) {
        const WindingNumber winding({ cloth.positions, rows_of(cloth.triangles, outward) });
        for (const Patch* patch : flat)
            if (faces_inwards(cloth, *patch, winding))
                for (const int f : patch->faces)
                    turn(cloth.triangles, f);
    }
    return without_inner_sheets(cloth, patches);
}

TriangleMesh turned(TriangleMesh cloth, const Eigen::Quaterniond& turn)
{
    cloth.positions = (cloth.positions * turn.toRotationMatrix().transpose()).eval();
    return cloth;
}

}  // namespace fit
