// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/convex_hull_2.h>

#include "garmentfit/fit_map.h"
#include "skin_weights.h"
#include "tuning.h"

namespace garmentfit {
namespace {

struct Plane {
    Vec3 point, normal;
};

/// A surface to measure.
struct MeasuredSurface {
    const Positions& positions;
    const Triangles& triangles;
    std::vector<int> bones;  // that each vertex follows most
};

using Bones = std::vector<int>;

/// Points at which the plane cuts the edges of the surface that hang on these bones.
std::vector<Vec3> cut_edges(const MeasuredSurface& surface, const Bones& bones, const Plane& plane)
{
    std::vector<Vec3> points;
    const auto counts = [&](int v) { return std::find(bones.begin(), bones.end(), surface.bones[v]) != bones.end(); };
    for (const auto& corners : surface.triangles.rowwise())
        for (int k = 0; k < 3; ++k) {
            const int i = corners[k], j = corners[(k + 1) % 3];
            const Vec3 a = surface.positions.row(i), b = surface.positions.row(j);
            const double from = (a - plane.point).dot(plane.normal), to = (b - plane.point).dot(plane.normal);
            if ((from < 0) != (to < 0) && counts(i) && counts(j))
                points.push_back(a + from / (from - to) * (b - a));
        }
    return points;
}

/// The length of a tape drawn tight round the points: of their convex hull in the plane. None where the points do not
/// go round the plane's point, but lie beside it.
std::optional<double> measure_tape(const std::vector<Vec3>& points, const Plane& plane)
{
    using Kernel = CGAL::Simple_cartesian<double>;
    const Vec3 u = plane.normal.unitOrthogonal(), v = plane.normal.cross(u);
    std::array<bool, k_girth_sectors> seen {};
    std::vector<Kernel::Point_2> flat, hull;
    for (const Vec3& point : points) {
        const double x = (point - plane.point).dot(u), y = (point - plane.point).dot(v);
        flat.emplace_back(x, y);
        seen[std::min(int((std::atan2(y, x) / M_PI + 1) / 2 * k_girth_sectors), k_girth_sectors - 1)] = true;
    }
    if (std::count(seen.begin(), seen.end(), true) < k_needed_sectors)
        return {};
    CGAL::convex_hull_2(flat.begin(), flat.end(), std::back_inserter(hull));
    double length = 0;
    for (std::size_t i = 0; i < hull.size(); ++i)
        length += std::sqrt(CGAL::squared_distance(hull[i], hull[(i + 1) % hull.size()]));
    return length;
}

/// Where a tape is laid: on a line along the body.
struct TapeLine {
    const char* name;
    Bones bones;  // whose skin and cloth count
    Vec3 from, to, axis;
    int choice;  // 1: where the body is widest on the line, -1: narrowest, 0: at `from`
};

std::vector<TapeLine> list_tape_lines(const Skeleton& s)
{
    const auto on = [&](int bone, double share) { return Vec3(s.head(bone) + share * (s.tail(bone) - s.head(bone))); };
    const auto limb = [&](const char* name, int bone, double share) {
        return TapeLine { name, { bone }, on(bone, share), on(bone, share), s.direction(bone), 0 };
    };
    const Bones trunk { lowerback, upperback, thorax, lclavicle, rclavicle, lhipjoint, rhipjoint };
    Bones pelvis { lowerback, lhipjoint, rhipjoint };
    const Vec3 down = -s.direction(lowerback);
    for (const int thigh : { lfemur, rfemur })
        if (s.direction(thigh).dot(down) > k_hanging_thigh)
            pelvis.push_back(thigh);
    const Vec3 seat = s.root + k_seat_at * s.length(lfemur) * down;
    return {
        { "neck",
          { lowerneck, upperneck },
          on(lowerneck, k_neck_at),
          on(lowerneck, k_neck_at),
          s.direction(lowerneck),
          0 },
        { "chest", trunk, on(upperback, k_chest_from), on(thorax, k_chest_to), s.direction(thorax), 1 },
        { "waist", trunk, on(lowerback, k_waist_from), on(upperback, k_waist_to), s.direction(upperback), -1 },
        { "hips", pelvis, s.root, seat, down, 1 },
        limb("left thigh", lfemur, k_thigh_at),
        limb("right thigh", rfemur, k_thigh_at),
        limb("left upper arm", lhumerus, k_upper_arm_at),
        limb("right upper arm", rhumerus, k_upper_arm_at),
    };
}

/// Where on its line the tape is laid on a body, and the body's girth there.
struct BodyGirth {
    Plane plane;
    double girth;  // m
};

std::optional<BodyGirth> measure_body(const MeasuredSurface& body, const TapeLine& line)
{
    std::optional<BodyGirth> best;
    for (int i = 0; i < (line.choice == 0 ? 1 : k_girth_planes); ++i) {
        const Plane plane { line.from + double(i) / (k_girth_planes - 1) * (line.to - line.from), line.axis };
        const auto girth = measure_tape(cut_edges(body, line.bones, plane), plane);
        if (girth && (!best || line.choice * (*girth - best->girth) > 0))
            best = BodyGirth { plane, *girth };
    }
    return best;
}

}  // namespace

std::vector<Girth> girths(const Skeleton& skeleton, const SkinWeights& weights, const TriangleMesh& body,
                          const WornGarment& worn)
{
    const MeasuredSurface skin { body.positions, body.triangles, strongest_bones(weights) };
    const MeasuredSurface cloth { worn.positions, worn.rest.triangles,
                                  strongest_bones(weights_of_nearest(worn.positions, body.positions, weights)) };
    std::vector<Girth> result;
    for (const TapeLine& line : list_tape_lines(skeleton))
        if (const auto found = measure_body(skin, line))
            if (const auto girth = measure_tape(cut_edges(cloth, line.bones, found->plane), found->plane))
                result.push_back({ line.name, found->girth, *girth });
    return result;
}

}  // namespace garmentfit
