// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Pictures without a graphics card: what a camera far away sees of a body and its clothes.

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "garmentfit/types.h"

namespace garmentfit::fixtures {

enum class Seen : char { nothing, skin, inside_of_skin, cloth };

/// Parallel light rays along `direction`, `pixels` along the longer side of what there is to see.
class View {
public:
    View(const Vec3& direction, int pixels, const Positions& all) :
        toward_(direction.normalized()), right_(toward_.unitOrthogonal()), up_(right_.cross(toward_)), pixels_(pixels)
    {
        const Eigen::VectorXd x = all * right_, y = all * up_;
        corner_ = { x.minCoeff(), y.minCoeff() };
        scale_ = pixels / std::max(x.maxCoeff() - x.minCoeff(), y.maxCoeff() - y.minCoeff());
        depths.assign(std::size_t(pixels) * std::size_t(pixels), std::numeric_limits<double>::infinity());
        seen.assign(depths.size(), Seen::nothing);
    }

    /// Faces wound against the clock from outside. A side that shows `nothing` is not drawn.
    void add(const Positions& positions, const Triangles& triangles, Seen front, Seen back)
    {
        for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
            Eigen::Matrix3d corners;  // a column each: x, y in pixels, depth in metres
            for (int k = 0; k < 3; ++k) {
                const Vec3 p = positions.row(triangles(f, k));
                corners.col(k) << scale_ * (p.dot(right_) - corner_.x()), scale_ * (p.dot(up_) - corner_.y()),
                    p.dot(toward_);
            }
            draw(corners, front, back);
        }
    }

    std::vector<double> depths;  ///< of each pixel, along the direction, in metres
    std::vector<Seen> seen;  ///< of each pixel

private:
    static double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

    void draw(const Eigen::Matrix3d& corners, Seen front, Seen back)
    {
        const Eigen::Vector2d a = corners.col(0).head<2>(), b = corners.col(1).head<2>(), c = corners.col(2).head<2>();
        const double area = cross(b - a, c - a);
        if (area == 0 || (area > 0 ? front : back) == Seen::nothing)
            return;
        const auto first = [&](int axis) { return std::max(0, int(std::ceil(corners.row(axis).minCoeff() - 0.5))); };
        const auto last
            = [&](int axis) { return std::min(pixels_ - 1, int(std::floor(corners.row(axis).maxCoeff() - 0.5))); };
        for (int y = first(1); y <= last(1); ++y)
            for (int x = first(0); x <= last(0); ++x) {
                const Eigen::Vector2d p(x + 0.5, y + 0.5);
                const Vec3 shares = Vec3(cross(c - b, p - b), cross(a - c, p - c), cross(b - a, p - a)) / area;
                if (shares.minCoeff() < 0)
                    continue;
                const double depth = corners.row(2).dot(shares);
                const std::size_t at = std::size_t(y) * std::size_t(pixels_) + std::size_t(x);
                if (depth < depths[at]) {
                    depths[at] = depth;
                    seen[at] = area > 0 ? front : back;
                }
            }
    }

    Vec3 toward_, right_, up_;
    Eigen::Vector2d corner_;
    double scale_ = 1;
    int pixels_;
};

/// Pixels that show skin, and what they show where covered skin is left out.
struct Holes {
    long skin = 0;  ///< pixels of skin with the whole body
    long through = 0;  ///< of these: the inner side of the skin, or nothing
    long deep = 0;  ///< of these: cloth far behind the skin

    Holes& operator+=(const Holes& other)
    {
        skin += other.skin;
        through += other.through;
        deep += other.deep;
        return *this;
    }
};

struct Worn {
    Positions body, cloth;
    Triangles faces, shown_faces, cloth_faces;
};

/// The same view with all of the body, and without its covered skin.
struct Pair {
    View whole, shown;
};

inline Pair views_of(const Worn& worn, const Vec3& direction, int pixels)
{
    Positions all(worn.body.rows() + worn.cloth.rows(), 3);
    all << worn.body, worn.cloth;
    View cloth(direction, pixels, all);
    cloth.add(worn.cloth, worn.cloth_faces, Seen::cloth, Seen::cloth);
    Pair views { cloth, cloth };
    views.whole.add(worn.body, worn.faces, Seen::skin, Seen::inside_of_skin);
    views.shown.add(worn.body, worn.shown_faces, Seen::skin, Seen::inside_of_skin);
    return views;
}

inline Holes holes_seen(const Worn& worn, const Vec3& direction, int pixels)
{
    constexpr double k_far_behind = 0.03;  // m: cloth on the other side of a limb, not the cloth that skin came through
    const auto [whole, shown] = views_of(worn, direction, pixels);
    Holes holes;
    for (std::size_t p = 0; p < whole.seen.size(); ++p)
        if (whole.seen[p] == Seen::skin) {
            ++holes.skin;
            holes.through += shown.seen[p] == Seen::nothing || shown.seen[p] == Seen::inside_of_skin;
            holes.deep += shown.seen[p] == Seen::cloth && shown.depths[p] > whole.depths[p] + k_far_behind;
        }
    return holes;
}

/// Pixels that show skin with cloth right under it: skin that came out of the cloth.
inline long skin_before_cloth(const TriangleMesh& body, const TriangleMesh& cloth, const Vec3& direction, int pixels)
{
    Positions all(body.positions.rows() + cloth.positions.rows(), 3);
    all << body.positions, cloth.positions;
    View clothes(direction, pixels, all), front(direction, pixels, all), back(direction, pixels, all);
    clothes.add(cloth.positions, cloth.triangles, Seen::cloth, Seen::cloth);
    front.add(body.positions, body.triangles, Seen::skin, Seen::inside_of_skin);
    back.add(body.positions, body.triangles, Seen::nothing, Seen::inside_of_skin);
    long count = 0;
    for (std::size_t p = 0; p < front.seen.size(); ++p)
        count
            += front.seen[p] == Seen::skin && front.depths[p] < clothes.depths[p] && clothes.depths[p] < back.depths[p];
    return count;
}

/// Number `i` of `count` directions, evenly over the sphere: a Fibonacci lattice.
inline Vec3 direction_of(int i, int count)
{
    const double height = 1 - (2 * i + 1.0) / count, radius = std::sqrt(1 - height * height);
    const double turn = 2 * std::numbers::pi * i / std::numbers::phi;
    return { radius * std::cos(turn), height, radius * std::sin(turn) };
}

}  // namespace garmentfit::fixtures
