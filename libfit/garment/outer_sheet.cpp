// SPDX-License-Identifier: GPL-3.0-or-later
#include "outer_sheet.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "disjoint_sets.h"
#include "nearest.h"
#include "parallel.h"
#include "surface_measures.h"
#include "tuning.h"
#include "used_vertices.h"

namespace garmentfit {
namespace {

using namespace garment_tuning;

constexpr double k_ray_start = 1e-3;  // unit: thicknesses below a face, so that a ray does not hit it

/// Two faces belong to the same sheet, or to different sheets.
struct Relation {
    double uncertainty;  // 0 (coplanar, or behind at exactly the thickness) to 2
    int a, b;
    bool apart;

    bool operator<(const Relation& other) const
    {
        return std::tie(uncertainty, a, b) < std::tie(other.uncertainty, other.a, other.b);
    }
};

/// Disjoint sets of faces with a side relative to the root of the set: whether a face belongs to the root's sheet.
class Sheets {
public:
    explicit Sheets(std::size_t faces) : parent_(faces), other_side_(faces, 0)
    {
        std::iota(parent_.begin(), parent_.end(), 0);
    }

    void add(const Relation& relation)
    {
        const auto [a, a_side] = root(relation.a);
        const auto [b, b_side] = root(relation.b);
        if (a == b)
            return;  // known, or it contradicts relations that are more certain
        parent_[a] = b;
        other_side_[a] = a_side ^ b_side ^ char(relation.apart);
    }
    /// Root and side of a face.
    std::pair<int, char> root(int face)
    {
        int top = face;
        char side = 0;
        for (; parent_[top] != top; top = parent_[top])
            side ^= other_side_[top];
        const char found = side;
        while (parent_[face] != top && face != top) {  // path compression
            const int next = parent_[face];
            const char rest = side ^ other_side_[face];
            parent_[face] = top;
            other_side_[face] = side;
            side = rest;
            face = next;
        }
        return { top, found };
    }

private:
    std::vector<int> parent_;
    std::vector<char> other_side_;  // than the parent
};

std::vector<Vec3> area_vectors(const TriangleMesh& cloth)
{
    std::vector<Vec3> result(std::size_t(cloth.triangles.rows()));
    for (Eigen::Index f = 0; f < cloth.triangles.rows(); ++f)
        result[f] = area_vector(cloth.positions, cloth.triangles, f);
    return result;
}

Vec3 middle(const TriangleMesh& cloth, int face)
{
    return cloth.positions(cloth.triangles.row(face), Eigen::all).colwise().mean();
}

/// The face close behind a face belongs to the other sheet.
std::vector<Relation> relate_to_backs(const TriangleMesh& cloth, const std::vector<int>& faces,
                                      const std::vector<Vec3>& areas, double thickness)
{
    const TriangleTree tree({ cloth.positions, cloth.triangles(faces, Eigen::all) });
    std::vector<std::optional<Relation>> found(faces.size());
    parallel_for<std::size_t>(
        faces.size(),
        [&](std::size_t i) {
            const int f = faces[i];
            if (areas[f].norm() == 0)
                return;
            const Vec3 inwards = -areas[f].normalized();
            const auto hit = tree.first_hit(middle(cloth, f) + k_ray_start * thickness * inwards, inwards);
            if (hit && hit->distance < k_backing * thickness && hit->cosine > k_back_cosine)
                found[i] = { std::abs(hit->distance / thickness - 1) / k_backing + 1 - hit->cosine, f,
                             faces[hit->triangle], true };
        },
        256);  // unit: grain of the parallel loop
    std::vector<Relation> relations;
    for (const auto& one : found)
        if (one)
            relations.push_back(*one);
    return relations;
}

/// Neighbours belong to the same sheet, with an uncertainty that grows with the angle, as at a rim or a fold.
std::vector<Relation> relate_to_neighbours(const std::vector<int>& faces, const std::vector<int>& opposite,
                                           const std::vector<Vec3>& areas)
{
    std::vector<Relation> relations;
    for (const int f : faces)
        for (int e = 3 * f; e < 3 * f + 3; ++e)
            if (const int other = opposite[e] / 3; opposite[e] > e)
                relations.push_back(
                    { 1 - areas[f].stableNormalized().dot(areas[other].stableNormalized()), f, other, false });
    return relations;
}

/// Drops connected parts with a small area: strips of rims and folds.
std::vector<int> drop_small_parts(const std::vector<int>& faces, const std::vector<int>& opposite,
                                  const std::vector<Vec3>& areas)
{
    std::vector<char> is_kept(areas.size(), 0);
    for (const int f : faces)
        is_kept[f] = 1;
    DisjointSets joined { int(areas.size()) };
    for (const int f : faces)
        for (int e = 3 * f; e < 3 * f + 3; ++e)
            if (opposite[e] >= 0 && is_kept[opposite[e] / 3])
                joined.join(f, opposite[e] / 3);
    std::map<int, double> area;
    double total = 0;
    for (const int f : faces) {
        area[joined.root(f)] += areas[f].norm();
        total += areas[f].norm();
    }
    std::vector<int> result;
    for (const int f : faces)
        if (area[joined.root(f)] > k_small_part * total)
            result.push_back(f);
    return result;
}

/// What all relations between two smooth regions say together, by area: where sheets of coarse cloth pass through each
/// other, single faces have the wrong one close behind them, with more certainty than creases have.
std::vector<Relation> add_up(const std::vector<Relation>& relations, const std::vector<Vec3>& areas)
{
    DisjointSets regions { int(areas.size()) };
    std::vector<Relation> result;
    for (const Relation& relation : relations)
        if (!relation.apart && relation.uncertainty < k_smooth_region) {
            regions.join(relation.a, relation.b);
            result.push_back(relation);
            result.back().uncertainty = -std::numeric_limits<double>::infinity();
        }
    std::map<std::pair<int, int>, double> votes;  // m^2, for one sheet
    for (const Relation& relation : relations) {
        const int a = regions.root(relation.a), b = regions.root(relation.b);
        const double weight
            = std::min(areas[relation.a].norm(), areas[relation.b].norm()) * (1 - relation.uncertainty / 2);
        if (a != b)
            votes[{ std::min(a, b), std::max(a, b) }] += relation.apart ? -weight : weight;
    }
    for (const auto& [pair, vote] : votes)
        result.push_back({ -std::abs(vote), pair.first, pair.second, vote < 0 });
    return result;
}

/// The outer one of two sheets encloses a positive volume. The inner one is oriented towards the body, so its volume is
/// negative.
std::vector<int> outer_of(const TriangleMesh& cloth, const std::vector<int>& faces, const std::vector<Vec3>& areas,
                          std::vector<Relation> relations)
{
    std::sort(relations.begin(), relations.end());
    Sheets sheets(areas.size());
    for (const Relation& relation : relations)
        sheets.add(relation);
    std::map<int, double> volumes;  // by root: three times the volume of the root's side minus that of the other side
    const Vec3 origin = middle(cloth, faces[0]);
    for (const int f : faces) {
        const auto [root, side] = sheets.root(f);
        volumes[root] += (side ? -1 : 1) * areas[f].dot(middle(cloth, f) - origin);
    }
    std::vector<int> outer;
    for (const int f : faces)
        if (const auto [root, side] = sheets.root(f); (volumes[root] > 0) == (side == 0))
            outer.push_back(f);
    return outer;
}

/// m, of the outline of some faces.
double outline_of(const TriangleMesh& cloth, const std::vector<int>& faces, const std::vector<int>& opposite)
{
    std::vector<char> is_among(std::size_t(cloth.triangles.rows()), 0);
    for (const int f : faces)
        is_among[f] = 1;
    double length = 0;
    for (const int f : faces)
        for (int k = 0; k < 3; ++k)
            if (const int other = opposite[3 * f + k]; other < 0 || !is_among[other / 3])
                length += (cloth.positions.row(cloth.triangles(f, (k + 1) % 3))
                           - cloth.positions.row(cloth.triangles(f, k)))
                              .norm();
    return length;
}

}  // namespace

std::vector<int> outer_sheet(const TriangleMesh& cloth, const std::vector<int>& faces, const std::vector<int>& opposite,
                             double thickness)
{
    const std::vector<Vec3> areas = area_vectors(cloth);
    std::vector<Relation> relations = relate_to_neighbours(faces, opposite, areas);
    const std::vector<Relation> backs = relate_to_backs(cloth, faces, areas, thickness);
    relations.insert(relations.end(), backs.begin(), backs.end());
    std::vector<int> outer = outer_of(cloth, faces, areas, relations);
    const double outline = outline_of(cloth, outer, opposite);
    if (outline > k_longest_borders
            * diagonal(cloth.positions(used_vertices(cloth.triangles(faces, Eigen::all)), Eigen::all))) {
        std::vector<int> voted = outer_of(cloth, faces, areas, add_up(relations, areas));
        const double share = area(areas, voted) / area(areas, faces);
        if (std::abs(share - 0.5) < k_half_of_sheets && outline_of(cloth, voted, opposite) < outline)
            outer = std::move(voted);
    }
    return drop_small_parts(outer, opposite, areas);
}

}  // namespace garmentfit
