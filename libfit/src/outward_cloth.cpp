// SPDX-License-Identifier: GPL-3.0-or-later
#include "outward_cloth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "winding_number.h"

namespace fit {
namespace {

constexpr double k_weld_fraction = 1e-6;  // of the diagonal: what file formats round away, far below a stitch
constexpr double k_flat_patch = 0.01;     // volume / area^1.5; a sphere has 0.094, a sleeve 0.03, a pocket 0.002
constexpr double k_side_step = 0.02;      // m; how far a flat patch looks to either side of itself

using Face = std::array<int, 3>;

// Equal vertices become one; vertices without a face are left behind.
TriangleMesh welded(const GarmentMesh& garment)
{
    const Vec3 low = garment.positions.colwise().minCoeff();
    const double diagonal = (Vec3(garment.positions.colwise().maxCoeff()) - low).norm();
    const double cell = std::max(k_weld_fraction * diagonal, 1e-300);
    std::map<std::array<long long, 3>, int> row_of;
    std::vector<int> row(garment.positions.rows());
    std::vector<int> first;
    for (const int v : garment.triangles.reshaped()) {
        std::array<long long, 3> key;
        for (int k = 0; k < 3; ++k)
            key[k] = std::llround((garment.positions(v, k) - low[k]) / cell);
        const auto [found, is_new] = row_of.try_emplace(key, int(first.size()));
        if (is_new)
            first.push_back(v);
        row[v] = found->second;
    }
    TriangleMesh mesh;
    mesh.positions = garment.positions(first, Eigen::all);
    mesh.triangles = garment.triangles.unaryExpr([&](int v) { return row[v]; });
    return mesh;
}

std::vector<Face> distinct_faces(const Triangles& triangles)
{
    std::map<Face, Face> faces;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        const Face face { triangles(f, 0), triangles(f, 1), triangles(f, 2) };
        Face key = face;
        std::sort(key.begin(), key.end());
        if (key[0] != key[1] && key[1] != key[2])
            faces.try_emplace(key, face);
    }
    std::vector<Face> result;
    for (const auto& [key, face] : faces)
        result.push_back(face);
    return result;
}

bool runs_along(const Face& face, int from, int to)
{
    for (int k = 0; k < 3; ++k)
        if (face[k] == from && face[(k + 1) % 3] == to)
            return true;
    return false;
}

using EdgeFaces = std::map<std::pair<int, int>, std::vector<int>>;

EdgeFaces faces_by_edge(const std::vector<Face>& faces)
{
    EdgeFaces result;
    for (int f = 0; f < int(faces.size()); ++f)
        for (int k = 0; k < 3; ++k)
            result[std::minmax(faces[f][k], faces[f][(k + 1) % 3])].push_back(f);
    return result;
}

// Patches are joined through edges of exactly two faces; faces are turned to agree with the first of their patch.
std::vector<std::vector<int>> consistent_patches(std::vector<Face>& faces)
{
    const EdgeFaces by_edge = faces_by_edge(faces);
    std::vector<bool> seen(faces.size(), false);
    std::vector<std::vector<int>> patches;
    for (int seed = 0; seed < int(faces.size()); ++seed) {
        if (seen[seed])
            continue;
        std::vector<int> patch { seed };
        seen[seed] = true;
        for (std::size_t next = 0; next < patch.size(); ++next)
            for (int k = 0; k < 3; ++k) {
                const int from = faces[patch[next]][k], to = faces[patch[next]][(k + 1) % 3];
                const auto& pair = by_edge.at(std::minmax(from, to));
                if (pair.size() != 2)
                    continue;
                const int other = pair[0] == patch[next] ? pair[1] : pair[0];
                if (seen[other])
                    continue;
                seen[other] = true;
                if (runs_along(faces[other], from, to))
                    std::swap(faces[other][1], faces[other][2]);
                patch.push_back(other);
            }
        patches.push_back(std::move(patch));
    }
    return patches;
}

Triangles rows_of(const std::vector<Face>& faces, const std::vector<int>& patch)
{
    Triangles rows(patch.size(), 3);
    for (std::size_t i = 0; i < patch.size(); ++i)
        rows.row(i) << faces[patch[i]][0], faces[patch[i]][1], faces[patch[i]][2];
    return rows;
}

Vec3 area_vector(const Positions& p, const Triangles& t, Eigen::Index f)
{
    const Vec3 a = p.row(t(f, 0)), b = p.row(t(f, 1)), c = p.row(t(f, 2));
    return 0.5 * (b - a).cross(c - a);
}

std::vector<std::pair<int, int>> border_of(const Triangles& triangles)
{
    std::set<std::pair<int, int>> edges;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k)
            edges.insert({ triangles(f, k), triangles(f, (k + 1) % 3) });
    std::vector<std::pair<int, int>> border;
    for (const auto& [a, b] : edges)
        if (!edges.count({ b, a }))
            border.emplace_back(a, b);
    return border;
}

// Disjoint sets of vertices, by their connection along an opening's edge.
class Rings {
public:
    void join(int a, int b) { parent_[root(a)] = root(b); }
    int root(int v)
    {
        int& up = parent_.try_emplace(v, v).first->second;
        return up == v ? v : up = root(up);
    }

private:
    std::map<int, int> parent_;
};

// Volume of the patch with each of its openings closed by a fan to the opening's middle.
double closed_volume(const Positions& positions, const Triangles& triangles)
{
    const Vec3 origin = positions.row(triangles(0, 0));
    const auto at = [&](int v) { return Vec3(Vec3(positions.row(v)) - origin); };
    const auto tetrahedron = [](const Vec3& a, const Vec3& b, const Vec3& c) { return a.dot(b.cross(c)) / 6; };
    double volume = 0;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        volume += tetrahedron(at(triangles(f, 0)), at(triangles(f, 1)), at(triangles(f, 2)));

    const auto border = border_of(triangles);
    Rings rings;
    for (const auto& [a, b] : border)
        rings.join(a, b);
    std::map<int, std::pair<Vec3, int>> sums;
    for (const auto& [a, b] : border) {
        auto& [sum, count] = sums.try_emplace(rings.root(a), Vec3(Vec3::Zero()), 0).first->second;
        sum += at(a);
        ++count;
    }
    for (const auto& [a, b] : border) {
        const auto& [sum, count] = sums.at(rings.root(a));
        volume += tetrahedron(at(b), at(a), sum / count);
    }
    return volume;
}

double area_of(const Positions& positions, const Triangles& triangles)
{
    double area = 0;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        area += area_vector(positions, triangles, f).norm();
    return area;
}

void turn(Triangles& triangles) { triangles.col(1).swap(triangles.col(2)); }

Triangles joined(const std::vector<Triangles>& patches)
{
    Eigen::Index count = 0;
    for (const auto& patch : patches)
        count += patch.rows();
    Triangles all(count, 3);
    Eigen::Index row = 0;
    for (const auto& patch : patches) {
        all.middleRows(row, patch.rows()) = patch;
        row += patch.rows();
    }
    return all;
}

// A pocket encloses nothing itself: it faces away from what the rest of the garment encloses.
bool faces_inwards(const Positions& positions, const Triangles& patch, const WindingNumber& winding)
{
    double vote = 0;
    for (Eigen::Index f = 0; f < patch.rows(); ++f) {
        const Vec3 area = area_vector(positions, patch, f);
        if (area.norm() == 0)
            continue;
        const Vec3 middle = (positions.row(patch(f, 0)) + positions.row(patch(f, 1)) + positions.row(patch(f, 2))) / 3;
        const Vec3 step = k_side_step * area.normalized();
        vote += area.norm() * (winding(middle + step) - winding(middle - step));
    }
    return vote > 0;
}

}  // namespace

TriangleMesh outward_cloth(const GarmentMesh& garment)
{
    TriangleMesh cloth = welded(garment);
    std::vector<Face> faces = distinct_faces(cloth.triangles);
    std::vector<Triangles> outward, flat;
    for (const auto& patch : consistent_patches(faces)) {
        Triangles part = rows_of(faces, patch);
        const double volume = closed_volume(cloth.positions, part);
        if (volume < 0)
            turn(part);
        const bool encloses = std::abs(volume) > k_flat_patch * std::pow(area_of(cloth.positions, part), 1.5);
        (encloses ? outward : flat).push_back(std::move(part));
    }
    if (!outward.empty()) {
        const WindingNumber winding({ cloth.positions, joined(outward) });
        for (Triangles& part : flat)
            if (faces_inwards(cloth.positions, part, winding))
                turn(part);
    }
    outward.insert(outward.end(), flat.begin(), flat.end());
    cloth.triangles = joined(outward);
    return cloth;
}

}  // namespace fit
