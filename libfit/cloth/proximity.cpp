// SPDX-License-Identifier: GPL-3.0-or-later
#include "proximity.h"

#include <algorithm>
#include <cmath>

#include "tuning.h"

namespace garmentfit {
namespace {

// unit: edges count as parallel below this squared sine of their angle; any s serves then, because the clamps that
// follow find the closest pair of ends.
constexpr double k_parallel = 1e-14;
// literature: [li_2021_cipc], algorithm 1, whose s is 0.1.
constexpr double k_advance = 0.9;
// unit: more advances than motion of cloth takes; what takes more ends there.
constexpr int k_most_advances = 200;

// Parameter in [0, 1] of the projection of p onto the segment from a along ab; 0 for a segment of no length.
double project_onto_segment(const Vec3& p, const Vec3& a, const Vec3& ab)
{
    const double length2 = ab.squaredNorm();
    return length2 > 0 ? std::clamp((p - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
}

struct Barycentric {
    double a, b, c;
};

Barycentric nearest_on_border(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c)
{
    const double s = project_onto_segment(p, a, b - a), t = project_onto_segment(p, b, c - b),
                 u = project_onto_segment(p, c, a - c);
    const std::array<Barycentric, 3> candidates { { { 1 - s, s, 0 }, { 0, 1 - t, t }, { u, 0, 1 - u } } };
    const auto distance2 = [&](const Barycentric& w) { return (p - w.a * a - w.b * b - w.c * c).squaredNorm(); };
    return *std::min_element(candidates.begin(), candidates.end(),
                             [&](const auto& l, const auto& r) { return distance2(l) < distance2(r); });
}

Barycentric nearest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c)
{
    const Vec3 n = (b - a).cross(c - a);
    const double n2 = n.squaredNorm();
    if (n2 > 0) {
        const Vec3 pa = a - p, pb = b - p, pc = c - p;
        const double wa = pb.cross(pc).dot(n), wb = pc.cross(pa).dot(n), wc = pa.cross(pb).dot(n);
        if (wa >= 0 && wb >= 0 && wc >= 0)
            return { wa / n2, wb / n2, wc / n2 };
    }
    return nearest_on_border(p, a, b, c);
}

ClosestPoints closest_of_vertex_and_face(const Corners& x)
{
    const Barycentric w = nearest_on_triangle(x[0], x[1], x[2], x[3]);
    ClosestPoints result { { 1, -w.a, -w.b, -w.c }, 0 };
    result.distance = separation(result.weights, x).norm();
    return result;
}

// The names of [ericson_2005_collision], sec. 5.1.9.
ClosestPoints closest_of_edges(const Corners& x)
{
    const Vec3 d1 = x[1] - x[0], d2 = x[3] - x[2], r = x[0] - x[2];
    const double a = d1.squaredNorm(), e = d2.squaredNorm(), b = d1.dot(d2), c = d1.dot(r), f = d2.dot(r);
    const double denominator = a * e - b * b;
    double s = denominator > k_parallel * a * e ? std::clamp((b * f - c * e) / denominator, 0.0, 1.0) : 0.0;
    double t = e > 0 ? (b * s + f) / e : 0.0;
    if (t < 0 || t > 1 || e == 0) {
        t = std::clamp(t, 0.0, 1.0);
        s = project_onto_segment(x[2] + t * d2, x[0], d1);
    }
    ClosestPoints result { { 1 - s, s, t - 1, -t }, 0 };
    result.distance = separation(result.weights, x).norm();
    return result;
}

}  // namespace

ClosestPoints closest_points(PairKind kind, const Corners& x)
{
    return kind == PairKind::vertex_face ? closest_of_vertex_and_face(x) : closest_of_edges(x);
}

bool are_surely_apart(PairKind kind, const Corners& x, double distance)
{
    constexpr double k_rounding = 1e-9;  // unit: far more than the products round by
    const bool is_face = kind == PairKind::vertex_face;
    const Vec3 axis = is_face ? Vec3((x[1] + x[2] + x[3]) / 3 - x[0]) : Vec3(0.5 * (x[2] + x[3] - x[0] - x[1]));
    const double first = is_face ? x[0].dot(axis) : std::max(x[0].dot(axis), x[1].dot(axis));
    double second = std::min(x[2].dot(axis), x[3].dot(axis));
    if (is_face)
        second = std::min(second, x[1].dot(axis));
    const double gap = second - first;
    return gap > 0 && gap * gap > (1 + k_rounding) * distance * distance * axis.squaredNorm();
}

double relative_travel(PairKind kind, const Corners& d)
{
    const Vec3 mean = 0.25 * (d[0] + d[1] + d[2] + d[3]);
    const auto travel = [&](int k) { return (d[k] - mean).norm(); };
    if (kind == PairKind::vertex_face)
        return travel(0) + std::max({ travel(1), travel(2), travel(3) });
    return std::max(travel(0), travel(1)) + std::max(travel(2), travel(3));
}

double required_distance(double distance, double min_distance)
{
    if (distance > min_distance)
        return min_distance + k_kept_above_minimum * (distance - min_distance);
    return distance * (distance > k_rounding_zone * min_distance ? k_kept_below_minimum : k_kept_in_rounding_zone);
}

namespace {

/// Two primitives on their way.
class MovingPair {
public:
    /// @param travel  relative_travel of the displacements, not 0
    MovingPair(PairKind kind, const Corners& x, const Corners& displacements, double travel) :
        kind_(kind), x_(x), at_(closest_points(kind, x)), travel_(travel)
    {
        const Vec3 mean = 0.25 * (displacements[0] + displacements[1] + displacements[2] + displacements[3]);
        for (int k = 0; k < 4; ++k)
            d_[k] = displacements[k] - mean;
    }

    double distance() const { return at_.distance; }

    /// Of the displacements, that during which the distance surely stays above this one.
    double free_above(double distance) const
    {
        const double by_travel = (at_.distance - distance) / travel_;
        return at_.distance > k_touching ? std::max(by_travel, free_along_axis(distance)) : by_travel;
    }

    void advance(double fraction)
    {
        for (int k = 0; k < 4; ++k)
            x_[k] += fraction * d_[k];
        at_ = closest_points(kind_, x_);
    }

private:
    /// Convex things that move linearly are at least as far apart as the gap between them along a fixed axis, here that
    /// of their closest points. It shrinks as the corners approach along it: what slides or parts goes far at once, for
    /// which the travel alone needs hundreds of advances.
    double free_along_axis(double distance) const
    {
        const Vec3 axis = separation(at_.weights, x_) / at_.distance;
        const int firsts = kind_ == PairKind::vertex_face ? 1 : 2;
        double result = INFINITY;
        for (int a = 0; a < firsts; ++a)
            for (int b = firsts; b < 4; ++b)
                if (const double approach = axis.dot(d_[b] - d_[a]); approach > 0)
                    result = std::min(result, (axis.dot(x_[a] - x_[b]) - distance) / approach);
        return result;
    }

    PairKind kind_;
    Corners x_, d_;  // m, and without the common motion
    ClosestPoints at_;
    double travel_;
};

}  // namespace

double collision_free_fraction(PairKind kind, const Corners& x, const Corners& d, double min_distance)
{
    const double travel = relative_travel(kind, d);
    if (travel == 0)
        return 1;
    MovingPair pair(kind, x, d, travel);
    const double required = required_distance(pair.distance(), min_distance),
                 used_up = (1 - k_advance) * (pair.distance() - required);
    double t = 0;
    for (int i = 0; i < k_most_advances; ++i) {
        const double free = pair.free_above(required);
        if (free >= 1 - t)
            return 1;
        pair.advance(k_advance * free);
        t += k_advance * free;
        if (pair.distance() - required <= used_up)
            break;
    }
    return t;
}

}  // namespace garmentfit
