// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/fit_map.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/convex_hull_2.h>

#include "body_parts.h"
#include "cloth_energy.h"
#include "cloth_motion.h"
#include "layers.h"
#include "nearest.h"
#include "parallel.h"
#include "skin_weights.h"
#include "weld.h"

namespace garmentfit {
namespace {

// Cloth within this many contact distances of the skin leans on it.
constexpr double k_leans = 1.5;

// ---- maps --------------------------------------------------------------------------------------------------------

Eigen::VectorXd strains(const GarmentMesh& rest, const Positions& positions)
{
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(positions.rows()), count = sum;
    const auto edges = edges_of(rest.triangles);
    for (Eigen::Index e = 0; e < edges.rows(); ++e) {
        const int i = edges(e, 0), j = edges(e, 1);
        const double before = (rest.positions.row(i) - rest.positions.row(j)).norm();
        if (before == 0)
            continue;
        for (const int v : { i, j }) {
            sum[v] += (positions.row(i) - positions.row(j)).norm() / before - 1;
            count[v] += 1;
        }
    }
    return sum.array() / count.array().max(1);
}

// ---- the tape ----------------------------------------------------------------------------------------------------

struct Plane {
    Vec3 point, normal;
};

/// A surface, and which of its vertices may come under the tape.
struct Measured {
    const Positions& positions;
    const Triangles& triangles;
    std::vector<int> bones;  // that each vertex follows most
};

using Bones = std::vector<int>;

std::vector<Vec3> cut(const Measured& surface, const Bones& bones, const Plane& plane)
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

/// Nothing where the points do not go round the middle of the plane: what only lies beside it is no girth.
std::optional<double> tape(const std::vector<Vec3>& points, const Plane& plane)
{
    using Kernel = CGAL::Simple_cartesian<double>;
    constexpr int k_sectors = 8, k_needed = 6;
    const Vec3 u = plane.normal.unitOrthogonal(), v = plane.normal.cross(u);
    std::array<bool, k_sectors> seen {};
    std::vector<Kernel::Point_2> flat, hull;
    for (const Vec3& point : points) {
        const double x = (point - plane.point).dot(u), y = (point - plane.point).dot(v);
        flat.emplace_back(x, y);
        seen[std::min(int((std::atan2(y, x) / M_PI + 1) / 2 * k_sectors), k_sectors - 1)] = true;
    }
    if (std::count(seen.begin(), seen.end(), true) < k_needed)
        return {};
    CGAL::convex_hull_2(flat.begin(), flat.end(), std::back_inserter(hull));
    double length = 0;
    for (std::size_t i = 0; i < hull.size(); ++i)
        length += std::sqrt(CGAL::squared_distance(hull[i], hull[(i + 1) % hull.size()]));
    return length;
}

/// A place for the tape: somewhere on a line along the body.
struct Place {
    const char* name;
    Bones bones;  // whose skin and cloth count
    Vec3 from, to, axis;
    int choice;  // 1: where the body is widest, -1: narrowest, 0: at `from`
};

std::vector<Place> places(const Skeleton& s)
{
    const auto on = [&](int bone, double share) { return Vec3(s.head(bone) + share * (s.tail(bone) - s.head(bone))); };
    const auto limb = [&](const char* name, int bone, double share) {
        return Place { name, { bone }, on(bone, share), on(bone, share), s.direction(bone), 0 };
    };
    const Bones trunk { lowerback, upperback, thorax, lclavicle, rclavicle, lhipjoint, rhipjoint };
    Bones pelvis { lowerback, lhipjoint, rhipjoint };
    const Vec3 down = -s.direction(lowerback);
    for (const int thigh : { lfemur, rfemur })
        if (s.direction(thigh).dot(down) > std::sqrt(0.5))  // a thigh that is raised is not cut across
            pelvis.push_back(thigh);
    const Vec3 seat = s.root + 0.3 * s.length(lfemur) * down;
    return {
        { "neck", { lowerneck, upperneck }, on(lowerneck, 0.7), on(lowerneck, 0.7), s.direction(lowerneck), 0 },
        { "chest", trunk, on(upperback, 0.5), on(thorax, 0.6), s.direction(thorax), 1 },
        { "waist", trunk, on(lowerback, 0.5), on(upperback, 1), s.direction(upperback), -1 },
        { "hips", pelvis, s.root, seat, down, 1 },
        limb("left thigh", lfemur, 0.25),
        limb("right thigh", rfemur, 0.25),
        limb("left upper arm", lhumerus, 0.5),
        limb("right upper arm", rhumerus, 0.5),
    };
}

/// Where on the body a place turned out to be, and its girth there.
struct Found {
    Plane plane;
    double girth;  // m
};

std::optional<Found> found_on(const Measured& body, const Place& place)
{
    constexpr int k_tries = 9;
    std::optional<Found> best;
    for (int i = 0; i < (place.choice == 0 ? 1 : k_tries); ++i) {
        const Plane plane { place.from + double(i) / (k_tries - 1) * (place.to - place.from), place.axis };
        const auto girth = tape(cut(body, place.bones, plane), plane);
        if (girth && (!best || place.choice * (*girth - best->girth) > 0))
            best = Found { plane, *girth };
    }
    return best;
}

}  // namespace

FitMap fit_map(const TriangleMesh& body, const WornGarment& worn, const ClothOptions& options)
{
    const Weld weld(worn.rest);
    const GarmentMesh rest = weld.gathered(worn.rest);
    const Positions x = weld.gathered(worn.positions);
    const double density = material_of(options).density;
    const ClothEnergy energy(rest, {}, options);
    const Positions forces = energy.elastic_forces(x);
    const TriangleTree skin(body);

    Positions cloth(x.rows(), 3);  // ease, strain, pressure
    cloth.col(1) = strains(rest, x);
    parallel_for(x.rows(), [&](Eigen::Index v) {
        const Vec3 out = x.row(v).transpose() - skin.nearest(x.row(v));
        const double ease = out.norm(), mass = energy.masses()[v];
        const Vec3 force = forces.row(v).transpose() - mass * k_gravity * Vec3::UnitY();
        const double inwards = ease > 0 ? -force.dot(out) / ease : 0;
        cloth(v, 0) = ease;
        cloth(v, 2) = ease < k_leans * options.contact_distance ? std::max(inwards, 0.0) / (mass / density) : 0;
    });
    const Positions result = weld.spread(cloth);
    return { result.col(0), result.col(1), result.col(2) };
}

Overstretch overstretch(const SkinWeights& weights, const Positions& body, const WornGarment& worn)
{
    const auto edges = edges_of(worn.rest.triangles);
    Overstretch result;
    Vec3 place = Vec3::Zero();
    for (Eigen::Index e = 0; e < edges.rows(); ++e) {
        const int i = edges(e, 0), j = edges(e, 1);
        const double before = (worn.rest.positions.row(i) - worn.rest.positions.row(j)).norm();
        if (before == 0)
            continue;
        const double stretch = (worn.positions.row(i) - worn.positions.row(j)).norm() / before - 1;
        result.edges += stretch > k_overstretched;
        if (stretch > result.largest) {
            result.largest = stretch;
            place = 0.5 * (worn.positions.row(i) + worn.positions.row(j));
        }
    }
    if (result.edges == 0)
        return result;
    const int bone = strongest_bones(weights_of_nearest(Positions(place.transpose()), body, weights))[0];
    if (const int part = part_of(bone); part >= 0)
        result.part = part_name(part);
    return result;
}

std::vector<Girth> girths(const Skeleton& skeleton, const SkinWeights& weights, const TriangleMesh& body,
                          const WornGarment& worn)
{
    const Measured skin { body.positions, body.triangles, strongest_bones(weights) };
    const Measured cloth { worn.positions, worn.rest.triangles,
                           strongest_bones(weights_of_nearest(worn.positions, body.positions, weights)) };
    std::vector<Girth> result;
    for (const Place& place : places(skeleton))
        if (const auto body_there = found_on(skin, place))
            if (const auto garment = tape(cut(cloth, place.bones, body_there->plane), body_there->plane))
                result.push_back({ place.name, body_there->girth, *garment });
    return result;
}

}  // namespace garmentfit
