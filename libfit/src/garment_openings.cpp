// SPDX-License-Identifier: GPL-3.0-or-later
#include "garment_openings.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <queue>
#include <set>
#include <utility>

namespace fit {
namespace {

constexpr double k_smallest_girth = 0.07;  // of the garment's diagonal: a cuff has 0.12, a buttonhole 0.03
constexpr double k_slice = 0.02;           // of the diagonal: slices of a tube, two or three edges wide
constexpr double k_widening = 1.5;         // a tube ends where its girth exceeds its own median by this factor

using Ring = std::vector<std::pair<int, int>>;  // the edges of an opening
using Neighbours = std::vector<std::vector<std::pair<int, double>>>;

double diagonal_of(const TriangleMesh& mesh)
{
    return (mesh.positions.colwise().maxCoeff() - mesh.positions.colwise().minCoeff()).norm();
}

Neighbours neighbours_of(const TriangleMesh& mesh)
{
    Neighbours result(mesh.positions.rows());
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const int a = mesh.triangles(f, k), b = mesh.triangles(f, (k + 1) % 3);
            const double length = (mesh.positions.row(a) - mesh.positions.row(b)).norm();
            result[a].emplace_back(b, length);
            result[b].emplace_back(a, length);
        }
    return result;
}

// Directed as in their triangles, so that the cloth lies to the left seen from outside.
Ring border_edges(const Triangles& triangles)
{
    std::set<std::pair<int, int>> edges;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k)
            edges.emplace(triangles(f, k), triangles(f, (k + 1) % 3));
    Ring border;
    for (const auto& [a, b] : edges)
        if (!edges.count({ b, a }))
            border.emplace_back(a, b);
    return border;
}

std::vector<Ring> rings_of(const Ring& border)
{
    std::map<int, std::vector<int>> edges_at;
    for (int e = 0; e < int(border.size()); ++e) {
        edges_at[border[e].first].push_back(e);
        edges_at[border[e].second].push_back(e);
    }
    std::vector<bool> seen(border.size(), false);
    std::vector<Ring> rings;
    for (int seed = 0; seed < int(border.size()); ++seed) {
        if (seen[seed])
            continue;
        std::vector<int> queue { seed };
        seen[seed] = true;
        for (std::size_t next = 0; next < queue.size(); ++next)
            for (const int v : { border[queue[next]].first, border[queue[next]].second })
                for (const int e : edges_at[v])
                    if (!seen[e]) {
                        seen[e] = true;
                        queue.push_back(e);
                    }
        auto& ring = rings.emplace_back();
        for (const int e : queue)
            ring.push_back(border[e]);
    }
    return rings;
}

Opening opening_of(const Positions& positions, const Ring& ring)
{
    const auto at = [&](int v) { return Vec3(positions.row(v)); };
    Opening opening;
    opening.low = opening.high = at(ring[0].first);
    Vec3 area = Vec3::Zero();
    for (const auto& [a, b] : ring) {
        const double length = (at(b) - at(a)).norm();
        opening.girth += length;
        opening.centre += length * 0.5 * (at(a) + at(b));
        opening.low = opening.low.cwiseMin(at(a));
        opening.high = opening.high.cwiseMax(at(a));
    }
    opening.centre /= std::max(opening.girth, 1e-300);
    for (const auto& [a, b] : ring)  // the closing disc runs against the cloth's edges
        area += 0.5 * (at(b) - opening.centre).cross(at(a) - opening.centre);
    if (area.norm() > 0)
        opening.facing = area.normalized();
    return opening;
}

std::vector<Ring> large_rings(const Positions& positions, std::vector<Ring> rings, double smallest)
{
    const auto length = [&](const auto& ring) {
        double sum = 0;
        for (const auto& [a, b] : ring)
            sum += (positions.row(b) - positions.row(a)).norm();
        return sum;
    };
    std::erase_if(rings, [&](const auto& ring) { return length(ring) < smallest; });
    return rings;
}

std::vector<double> distances_from(const Neighbours& neighbours, const Ring& ring)
{
    std::vector<double> distance(neighbours.size(), std::numeric_limits<double>::infinity());
    std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> queue;
    for (const auto& [a, b] : ring) {
        distance[a] = 0;
        queue.emplace(0, a);
    }
    while (!queue.empty()) {
        const auto [d, v] = queue.top();
        queue.pop();
        if (d > distance[v])
            continue;
        for (const auto& [w, length] : neighbours[v])
            if (d + length < distance[w]) {
                distance[w] = d + length;
                queue.emplace(distance[w], w);
            }
    }
    return distance;
}

// The area between two distances from the opening is the girth there times their difference.
std::vector<double> girths_along(const TriangleMesh& mesh, const std::vector<double>& distance, double slice)
{
    std::vector<double> girths(1, 0.0);
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
        const int a = mesh.triangles(f, 0), b = mesh.triangles(f, 1), c = mesh.triangles(f, 2);
        const double mean = (distance[a] + distance[b] + distance[c]) / 3;
        if (!std::isfinite(mean))
            continue;
        const Vec3 u = mesh.positions.row(b) - mesh.positions.row(a), v = mesh.positions.row(c) - mesh.positions.row(a);
        const std::size_t bin = std::size_t(mean / slice);
        if (bin >= girths.size())
            girths.resize(bin + 1, 0.0);
        girths[bin] += 0.5 * u.cross(v).norm() / slice;
    }
    return girths;
}

// How far it is to the nearest other opening: there, slices begin to lack a part.
double reach_of(const std::vector<double>& distance, const std::vector<Ring>& rings, std::size_t own)
{
    double reach = std::numeric_limits<double>::infinity();
    for (std::size_t r = 0; r < rings.size(); ++r)
        if (r != own)
            for (const auto& [a, b] : rings[r])
                reach = std::min(reach, distance[a]);
    return reach;
}

// Hems may be turned in or gathered: the first slices neither end a tube nor count as its waist.
void measure_tube(Opening& opening, const std::vector<double>& girths, double slice)
{
    constexpr std::size_t hem = 3;
    std::vector<double> sorted;
    double median = opening.girth;
    opening.tube_waist = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < girths.size() && (i < hem || girths[i] <= k_widening * median); ++i) {
        sorted.insert(std::upper_bound(sorted.begin(), sorted.end(), girths[i]), girths[i]);
        median = sorted[sorted.size() / 2];
        if (i >= hem)
            opening.tube_waist = std::min(opening.tube_waist, girths[i]);
    }
    opening.tube_length = slice * double(sorted.size());
    opening.tube_girth = median;
    opening.tube_waist = std::min(opening.tube_waist, median);
}

std::vector<int> pieces_of(const TriangleMesh& mesh)
{
    std::vector<int> parent(mesh.positions.rows());
    for (int v = 0; v < int(parent.size()); ++v)
        parent[v] = v;
    const auto root = [&](int v) {
        while (parent[v] != v)
            v = parent[v] = parent[parent[v]];
        return v;
    };
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
        for (int k = 1; k < 3; ++k)
            parent[root(mesh.triangles(f, k))] = root(mesh.triangles(f, 0));
    for (int v = 0; v < int(parent.size()); ++v)
        parent[v] = root(v);
    return parent;
}

std::map<int, double> heights_of(const Positions& positions, const std::vector<int>& pieces)
{
    std::map<int, std::pair<double, double>> ranges;
    for (int v = 0; v < int(pieces.size()); ++v) {
        const double y = positions(v, 1);
        auto& [low, high] = ranges.try_emplace(pieces[v], y, y).first->second;
        low = std::min(low, y);
        high = std::max(high, y);
    }
    std::map<int, double> heights;
    for (const auto& [piece, range] : ranges)
        heights[piece] = range.second - range.first;
    return heights;
}

}  // namespace

std::vector<Opening> openings_of(const TriangleMesh& outward)
{
    const double diagonal = diagonal_of(outward), slice = k_slice * diagonal;
    const Neighbours neighbours = neighbours_of(outward);
    const std::vector<int> pieces = pieces_of(outward);
    const std::map<int, double> heights = heights_of(outward.positions, pieces);
    const auto rings = large_rings(outward.positions, rings_of(border_edges(outward.triangles)), k_smallest_girth * diagonal);
    std::vector<Opening> openings;
    for (std::size_t r = 0; r < rings.size(); ++r) {
        Opening opening = opening_of(outward.positions, rings[r]);
        opening.piece = pieces[rings[r][0].first];
        opening.piece_height = heights.at(opening.piece);
        const std::vector<double> distance = distances_from(neighbours, rings[r]);
        std::vector<double> girths = girths_along(outward, distance, slice);
        const double slices = std::clamp(reach_of(distance, rings, r) / slice, 1.0, double(girths.size()));
        girths.resize(std::size_t(slices));
        measure_tube(opening, girths, slice);
        openings.push_back(opening);
    }
    return openings;
}

bool is_sealed(const TriangleMesh& outward)
{
    if (!border_edges(outward.triangles).empty())
        return false;
    const std::vector<int> pieces = pieces_of(outward);
    const auto spheres = Eigen::Index(std::set<int>(pieces.begin(), pieces.end()).size());
    const Eigen::Index edges = 3 * outward.triangles.rows() / 2;
    return outward.positions.rows() - edges + outward.triangles.rows() == 2 * spheres;
}

}  // namespace fit
