// SPDX-License-Identifier: GPL-3.0-or-later
#include "outer_sheet.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "disjoint_sets.h"
#include "nearest.h"
#include "parallel.h"

namespace garmentfit {
namespace {

constexpr double k_backing = 3;  // thicknesses; along a rim it is further to the next cloth
constexpr double k_crumb = 0.05;  // of the sheet's area
constexpr double k_back = 0.5;  // cosine; less, and what lies behind a face is not the other sheet

// Two faces are of one sheet, or of two.
struct Statement {
    double doubt;  // 0 (level, or just behind) to 2
    int a, b;
    bool apart;

    bool operator<(const Statement& other) const
    {
        return std::tie(doubt, a, b) < std::tie(other.doubt, other.a, other.b);
    }
};

// Disjoint sets of faces; each face knows whether it is of the same sheet as its set's root.
class Sheets {
public:
    explicit Sheets(std::size_t faces) : parent_(faces), other_side_(faces, 0)
    {
        std::iota(parent_.begin(), parent_.end(), 0);
    }

    void state(const Statement& statement)
    {
        const auto [a, a_side] = root(statement.a);
        const auto [b, b_side] = root(statement.b);
        if (a == b)
            return;  // known, or a contradiction to what is surer
        parent_[a] = b;
        other_side_[a] = a_side ^ b_side ^ char(statement.apart);
    }
    /// Root and side of a face.
    std::pair<int, char> root(int face)
    {
        int top = face;
        char side = 0;
        for (; parent_[top] != top; top = parent_[top])
            side ^= other_side_[top];
        const char found = side;
        while (parent_[face] != top && face != top) {  // next time it is near
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
    for (Eigen::Index f = 0; f < cloth.triangles.rows(); ++f) {
        const Vec3 a = cloth.positions.row(cloth.triangles(f, 0)), b = cloth.positions.row(cloth.triangles(f, 1)),
                   c = cloth.positions.row(cloth.triangles(f, 2));
        result[f] = 0.5 * (b - a).cross(c - a);
    }
    return result;
}

Vec3 middle(const TriangleMesh& cloth, int face)
{
    return cloth.positions(cloth.triangles.row(face), Eigen::all).colwise().mean();
}

// What lies close behind a face is the other sheet.
std::vector<Statement> about_backs(const TriangleMesh& cloth, const std::vector<int>& faces,
                                   const std::vector<Vec3>& areas, double thickness)
{
    const TriangleTree tree({ cloth.positions, cloth.triangles(faces, Eigen::all) });
    std::vector<std::optional<Statement>> found(faces.size());
    parallel_for<std::size_t>(
        faces.size(),
        [&](std::size_t i) {
            const int f = faces[i];
            if (areas[f].norm() == 0)
                return;
            const Vec3 inwards = -areas[f].normalized();
            const auto hit = tree.first_hit(middle(cloth, f) + 1e-3 * thickness * inwards, inwards);
            if (hit && hit->distance < k_backing * thickness && hit->cosine > k_back)
                found[i] = { std::abs(hit->distance / thickness - 1) / k_backing + 1 - hit->cosine, f,
                             faces[hit->triangle], true };
        },
        256);
    std::vector<Statement> statements;
    for (const auto& one : found)
        if (one)
            statements.push_back(*one);
    return statements;
}

// Neighbours are of one sheet, unless there is a rim or a fold between them.
std::vector<Statement> about_neighbours(const std::vector<int>& faces, const std::vector<int>& opposite,
                                        const std::vector<Vec3>& areas)
{
    std::vector<Statement> statements;
    for (const int f : faces)
        for (int e = 3 * f; e < 3 * f + 3; ++e)
            if (const int other = opposite[e] / 3; opposite[e] > e)
                statements.push_back(
                    { 1 - areas[f].stableNormalized().dot(areas[other].stableNormalized()), f, other, false });
    return statements;
}

// Strips of rims, and of folds: what hangs together but has hardly any area.
std::vector<int> without_crumbs(const std::vector<int>& faces, const std::vector<int>& opposite,
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
    double whole = 0;
    for (const int f : faces) {
        area[joined.root(f)] += areas[f].norm();
        whole += areas[f].norm();
    }
    std::vector<int> result;
    for (const int f : faces)
        if (area[joined.root(f)] > k_crumb * whole)
            result.push_back(f);
    return result;
}

}  // namespace

std::vector<int> outer_sheet(const TriangleMesh& cloth, const std::vector<int>& faces, const std::vector<int>& opposite,
                             double thickness)
{
    const std::vector<Vec3> areas = area_vectors(cloth);
    std::vector<Statement> statements = about_neighbours(faces, opposite, areas);
    const std::vector<Statement> backs = about_backs(cloth, faces, areas, thickness);
    statements.insert(statements.end(), backs.begin(), backs.end());
    std::sort(statements.begin(), statements.end());
    Sheets sheets(areas.size());
    for (const Statement& statement : statements)
        sheets.state(statement);

    // The outer sheet encloses more than the inner one, which is turned towards the body and encloses less than nothing.
    std::map<int, double> volumes;  // by root, of its own side less the other one
    const Vec3 origin = middle(cloth, faces[0]);
    for (const int f : faces) {
        const auto [root, side] = sheets.root(f);
        volumes[root] += (side ? -1 : 1) * areas[f].dot(middle(cloth, f) - origin);
    }
    std::vector<int> outer;
    for (const int f : faces)
        if (const auto [root, side] = sheets.root(f); (volumes[root] > 0) == (side == 0))
            outer.push_back(f);
    return without_crumbs(outer, opposite, areas);
}

}  // namespace garmentfit
