// SPDX-License-Identifier: GPL-3.0-or-later
#include "proximity.h"

#include <algorithm>
#include <cmath>

namespace garmentfit {
namespace {

// Where on the segment ab the point p projects to, in [0, 1]; 0 for a segment of no length.
double along(const Vec3& p, const Vec3& a, const Vec3& ab)
{
    const double length2 = ab.squaredNorm();
    return length2 > 0 ? std::clamp((p - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
}

struct Barycentric {
    double a, b, c;
};

Barycentric nearest_on_border(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c)
{
    const double s = along(p, a, b - a), t = along(p, b, c - b), u = along(p, c, a - c);
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

Closest vertex_face(const Corners& x)
{
    const Barycentric w = nearest_on_triangle(x[0], x[1], x[2], x[3]);
    Closest result { { 1, -w.a, -w.b, -w.c }, 0 };
    result.distance = separation(result.weights, x).norm();
    return result;
}

Closest edge_edge(const Corners& x)
{
    const Vec3 d1 = x[1] - x[0], d2 = x[3] - x[2], r = x[0] - x[2];
    const double a = d1.squaredNorm(), e = d2.squaredNorm(), b = d1.dot(d2), c = d1.dot(r), f = d2.dot(r);
    const double denominator = a * e - b * b;
    // parallel to rounding: any s will do, the clamps below find the true closest pair of ends
    double s = denominator > 1e-14 * a * e ? std::clamp((b * f - c * e) / denominator, 0.0, 1.0) : 0.0;
    double t = e > 0 ? (b * s + f) / e : 0.0;
    if (t < 0 || t > 1 || e == 0) {
        t = std::clamp(t, 0.0, 1.0);
        s = along(x[2] + t * d2, x[0], d1);
    }
    Closest result { { 1 - s, s, t - 1, -t }, 0 };
    result.distance = separation(result.weights, x).norm();
    return result;
}

}  // namespace

Closest closest(PairKind kind, const Corners& x)
{
    return kind == PairKind::vertex_face ? vertex_face(x) : edge_edge(x);
}

double relative_travel(PairKind kind, const Corners& d)
{
    const Vec3 mean = 0.25 * (d[0] + d[1] + d[2] + d[3]);
    const auto travel = [&](int k) { return (d[k] - mean).norm(); };
    if (kind == PairKind::vertex_face)
        return travel(0) + std::max({ travel(1), travel(2), travel(3) });
    return std::max(travel(0), travel(1)) + std::max(travel(2), travel(3));
}

double kept_distance(double distance, double gap)
{
    if (distance > gap)
        return gap + 0.2 * (distance - gap);
    return distance > 0.01 * gap ? 0.9 * distance : 0.999 * distance;
}

double free_share(PairKind kind, Corners x, Corners d, double gap)
{
    constexpr int k_most_advances = 200;  // the free way at least doubles in two: more than any real motion needs
    const double travel = relative_travel(kind, d);
    if (travel == 0)
        return 1;
    double distance = closest(kind, x).distance;
    const double kept = kept_distance(distance, gap);
    if (travel <= distance - kept)
        return 1;
    const double never_below = kept - 0.25 * (distance - kept);
    const Vec3 mean = 0.25 * (d[0] + d[1] + d[2] + d[3]);
    double t = 0;
    for (int i = 0; i < k_most_advances; ++i) {
        const double advance = std::min(0.9 * (distance - never_below) / travel, 1 - t);
        for (int k = 0; k < 4; ++k)
            x[k] += advance * (d[k] - mean);
        distance = closest(kind, x).distance;
        if (distance < kept)
            return t;
        t += advance;
        if (t >= 1)
            return 1;
    }
    return t;
}

}  // namespace garmentfit
