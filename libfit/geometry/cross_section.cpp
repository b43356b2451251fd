// SPDX-License-Identifier: GPL-3.0-or-later
#include "cross_section.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace garmentfit {
namespace {

using EdgeKey = std::uint64_t;

EdgeKey key(int a, int b)
{
    const auto [low, high] = std::minmax(a, b);
    return (EdgeKey(low) << 32) | EdgeKey(high);
}

/// The part of the cut within one triangle: from one edge to another.
struct Step {
    EdgeKey leaves_by;
    Vec3 at;  // where the cut enters
    int vertex;  // above that place
};

/// The edge of triangle `f` that runs from below the plane to above it (or, `rising` = false, from above to below).
int crossing_edge(const Triangles& t, Eigen::Index f, const Eigen::VectorXd& height, bool rising)
{
    for (int k = 0; k < 3; ++k) {
        const bool from = height[t(f, k)] >= 0, to = height[t(f, (k + 1) % 3)] >= 0;
        if (from != to && to == rising)
            return k;
    }
    return -1;
}

std::unordered_map<EdgeKey, Step> steps_through(const TriangleMesh& mesh, const Eigen::VectorXd& height,
                                                std::vector<EdgeKey>& order)
{
    std::unordered_map<EdgeKey, Step> steps;
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
        // triangles run counter-clockwise seen from outside: with the falling edge as the entry, so does the outline
        // seen from above
        const int in = crossing_edge(mesh.triangles, f, height, false);
        if (in < 0)
            continue;
        const int out = crossing_edge(mesh.triangles, f, height, true);
        const auto end = [&](int k) { return mesh.triangles(f, k % 3); };
        const double high = height[end(in)], low = height[end(in + 1)];
        const Vec3 a = mesh.positions.row(end(in)), b = mesh.positions.row(end(in + 1));
        const EdgeKey enters_by = key(end(in), end(in + 1));
        steps.insert({ enters_by, { key(end(out), end(out + 1)), a + high / (high - low) * (b - a), end(in) } });
        order.push_back(enters_by);
    }
    return steps;
}

std::vector<CrossSection> outlines(const TriangleMesh& mesh, const Eigen::VectorXd& height)
{
    std::vector<EdgeKey> order;
    auto steps = steps_through(mesh, height, order);
    std::vector<CrossSection> result;
    for (const EdgeKey first : order) {
        CrossSection section;
        for (auto step = steps.find(first); step != steps.end();) {
            section.outline.push_back(step->second.at);
            section.vertices.push_back(step->second.vertex);
            const EdgeKey next = step->second.leaves_by;
            steps.erase(step);
            step = steps.find(next);
        }
        if (section.outline.size() >= 3)
            result.push_back(std::move(section));
    }
    return result;
}

void measure(CrossSection& section, const Vec3& normal)
{
    const std::vector<Vec3>& outline = section.outline;
    const Vec3 origin = outline.front();
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Vec3 a = outline[i] - origin, b = outline[(i + 1) % outline.size()] - origin;
        const double area = 0.5 * a.cross(b).dot(normal);
        section.area += area;
        section.centroid += area * (a + b) / 3;
        section.girth += (b - a).norm();
    }
    section.centroid = origin + section.centroid / section.area;
}

bool goes_round(const CrossSection& section, const Vec3& point, const Vec3& normal)
{
    double turn = 0;
    for (std::size_t i = 0; i < section.outline.size(); ++i) {
        const Vec3 a = section.outline[i] - point, b = section.outline[(i + 1) % section.outline.size()] - point;
        turn += std::atan2(a.cross(b).dot(normal), a.dot(b));
    }
    return turn > 3.14;  // derived: about half of one turn, 2 pi; the outline of a cavity turns the other way
}

}  // namespace

std::optional<CrossSection> Slicer::cut(const Vec3& point, const Vec3& normal) const
{
    const Eigen::VectorXd height = (mesh_.positions.rowwise() - point.transpose()) * normal;
    std::optional<CrossSection> best;
    for (CrossSection& section : outlines(mesh_, height)) {
        measure(section, normal);
        if (section.area > 0 && (!best || section.area < best->area) && goes_round(section, point, normal))
            best = std::move(section);
    }
    return best;
}

}  // namespace garmentfit
