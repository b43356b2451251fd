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
#include "disjoint_sets.h"
#include "outer_sheet.h"
#include "parallel.h"
#include "winding_number.h"

namespace garmentfit {
namespace {

constexpr double k_weld_fraction = 1e-6;  // of the diagonal: what file formats round away, far below a stitch
constexpr double k_flat_patch = 0.01;  // volume / area^1.5; a sphere has 0.094, a sleeve 0.03, a pocket 0.002
constexpr double k_thickest = 0.02;  // m between the sheets of cloth that has two
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
    parallel_for(int(lowest.size()), [&](int e) {
        int found = -1, count = 0;
        for (const int other : edges_at[lowest[e]])
            if (other != e && std::max(from(other), to(other)) == std::max(from(e), to(e))) {
                found = other;
                ++count;
            }
        opposite[e] = count == 1 ? found : -1;
    });
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

// m, between the sheets of a closed patch.
double thickness_of(const Patch& patch) { return 2 * std::abs(patch.volume) / patch.area; }

// Edges of more than two faces, at which it touches itself; none where an edge is open.
std::optional<std::ptrdiff_t> edges_touched(const Patch& patch)
{
    std::map<std::pair<int, int>, int> balance;  // open edges are left over when those run back and forth cancel
    for (const auto& [a, b] : patch.border)
        balance[std::minmax(a, b)] += a < b ? 1 : -1;
    for (const auto& [edge, count] : balance)
        if (count != 0)
            return {};
    return std::ptrdiff_t(balance.size());
}

// Closed all round, but for tunnels, with no more between its two sheets than padding.
bool is_thick_cloth(const Patch& patch, const Triangles& triangles)
{
    if (thickness_of(patch) > k_thickest)
        return false;
    const auto touched = edges_touched(patch);
    if (!touched)
        return false;
    std::set<int> vertices;
    for (const int f : patch.faces)
        for (int k = 0; k < 3; ++k)
            vertices.insert(triangles(f, k));
    const auto faces = std::ptrdiff_t(patch.faces.size());
    const auto edges = (3 * faces - std::ptrdiff_t(patch.border.size())) / 2 + *touched;
    return std::ptrdiff_t(vertices.size()) - edges + faces <= 0;  // Euler: tunnels
}

// Cloth with thickness has two sheets, and only the outer one is what a garment looks like without.
TriangleMesh without_inner_sheets(const TriangleMesh& cloth, const std::vector<Patch>& patches)
{
    if (std::none_of(patches.begin(), patches.end(),
                     [&](const Patch& patch) { return is_thick_cloth(patch, cloth.triangles); }))
        return cloth;
    const std::vector<int> opposite = opposite_edges(cloth.triangles, int(cloth.positions.rows()));
    std::vector<int> kept;
    for (const Patch& patch : patches) {
        const std::vector<int> faces = is_thick_cloth(patch, cloth.triangles)
            ? outer_sheet(cloth, patch.faces, opposite, thickness_of(patch))
            : patch.faces;
        kept.insert(kept.end(), faces.begin(), faces.end());
    }
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
    DisjointSets rings(vertices);
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
        const bool is_sure = patch.border.empty() || std::abs(patch.volume) > k_flat_patch * std::pow(patch.area, 1.5);
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

TriangleMesh rotate(TriangleMesh cloth, const Eigen::Quaterniond& turn)
{
    cloth.positions = (cloth.positions * turn.toRotationMatrix().transpose()).eval();
    return cloth;
}

}  // namespace garmentfit
