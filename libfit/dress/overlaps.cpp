// SPDX-License-Identifier: GPL-3.0-or-later
#include "overlaps.h"

#include <algorithm>
#include <cmath>

#include "body_parts.h"
#include "garmentfit/mesh.h"
#include "nearest.h"
#include "skin_weights.h"
#include "tuning.h"

namespace garmentfit {
namespace {

TriangleMesh skin_of(int part, const TriangleMesh& body, const std::vector<int>& parts)
{
    std::vector<int> rows;
    for (int t = 0; t < int(body.triangles.rows()); ++t)
        if (parts[body.triangles(t, 0)] == part)
            rows.push_back(t);
    return { body.positions, body.triangles(rows, Eigen::all) };
}

/// Vertices near cloth whose outward ray meets the inside of another part first.
std::vector<int> list_vertices_inside(const TriangleMesh& body, const std::vector<int>& parts,
                                      const std::vector<char>& near_cloth)
{
    const TriangleTree surface(body);
    const Positions normals = vertex_normals(body.positions, body.triangles);
    std::vector<int> result;
    for (int v = 0; v < int(normals.rows()); ++v) {
        const Vec3 outwards = normals.row(v), above = body.positions.row(v).transpose() + k_least_overlap * outwards;
        if (!near_cloth[v] || parts[v] < 0 || outwards.isZero())
            continue;
        const auto hit = surface.first_hit(above, outwards);
        if (hit && hit->from_behind && parts[body.triangles(hit->triangle, 0)] != parts[v])
            result.push_back(v);
    }
    return result;
}

}  // namespace

std::vector<Overlap> find_overlaps(const TriangleMesh& body, const SkinWeights& weights,
                                   const std::vector<char>& near_cloth)
{
    std::vector<int> parts = strongest_bones(weights);
    std::transform(parts.begin(), parts.end(), parts.begin(), part_of);
    std::vector<TriangleTree> skins;
    for (int p = 0; p < k_body_parts; ++p)
        skins.emplace_back(skin_of(p, body, parts));

    Eigen::MatrixXd depths = Eigen::MatrixXd::Zero(k_body_parts, k_body_parts);
    for (int v : list_vertices_inside(body, parts, near_cloth)) {
        double depth = INFINITY;
        int nearest = -1;
        for (int p = 0; p < k_body_parts; ++p)
            if (const double distance = skins[p].distance(body.positions.row(v)); p != parts[v] && distance < depth) {
                depth = distance;
                nearest = p;
            }
        if (nearest >= 0) {
            double& deepest = depths(std::min(parts[v], nearest), std::max(parts[v], nearest));
            deepest = std::max(deepest, depth);
        }
    }

    std::vector<Overlap> result;
    for (int a = 0; a < k_body_parts; ++a)
        for (int b = a + 1; b < k_body_parts; ++b)
            if (depths(a, b) > k_least_overlap)
                result.push_back({ part_name(a), part_name(b), depths(a, b) });
    std::sort(result.begin(), result.end(), [](const auto& a, const auto& b) { return a.depth > b.depth; });
    return result;
}

}  // namespace garmentfit
