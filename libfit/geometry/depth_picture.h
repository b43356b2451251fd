// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Depth pictures: which surfaces the parallel rays through the pixels of a picture meet, and how deep. A caller keeps of
// each ray what he needs: the nearest surface, the furthest, or several of each.
//
// Method  each triangle is tested at the centres of the pixels in its box. Triangles that share an edge leave no gap.
// Cost    O(n) for n triangles, if pixels are not much smaller than triangles.

#include <algorithm>
#include <cmath>

#include "garmentfit/types.h"

namespace garmentfit {

/// Rays along one direction, a pixel of `size` for each, over all points of a surface.
class PictureFrame {
public:
    PictureFrame(const Vec3& direction, double size, const Positions& surface);

    int width() const { return width_; }
    int height() const { return height_; }
    std::size_t pixels() const { return std::size_t(width_) * std::size_t(height_); }

    /// n x 3: column and row in pixels, depth along the direction in the unit of the points.
    Positions project(const Positions& points) const;

private:
    Eigen::Matrix3d axes_;  // a column each: right, up, along the rays
    Eigen::RowVector3d corner_;
    double size_;
    int width_, height_;
};

/// Of the columns (or rows) 0, ..., count: the first whose centre is at this place, in pixels, or beyond it.
inline int first_column(double place, int count)
{
    const double bounded = std::clamp(place - 0.5, -1.0, double(count));
    const int column = int(bounded);  // not std::ceil, which is a call on x86-64 without extensions
    return std::max(0, column + (bounded > column));
}

/// Twice the area of a triangle of an edge and a point, positive on one side of the edge: linear in the point.
class EdgeFunction {
public:
    EdgeFunction(const double* from, const double* to, double side) :
        from_(from), step_x_(side * (from[1] - to[1])), step_y_(side * (to[0] - from[0]))
    {
    }
    double at(double x, double y) const { return (x - from_[0]) * step_x_ + (y - from_[1]) * step_y_; }
    double step() const { return step_x_; }  ///< from a pixel to the next one of its row

private:
    const double* from_;
    double step_x_, step_y_;
};

/// Calls paint(pixel, depth, triangle, is_front) for each ray that meets a triangle. Fronts are wound against the clock
/// as they are seen along the direction.
/// @param projected  corners, of PictureFrame::project
template <class Paint>
void paint_triangles(const PictureFrame& frame, const Positions& projected, const Triangles& triangles,
                     const Paint& paint)
{
    constexpr double k_seam = 1e-9;  // unit: square pixels, far above the rounding of edge functions
    for (int t = 0; t < int(triangles.rows()); ++t) {
        const auto corner = [&](int k) { return projected.data() + 3 * std::size_t(triangles(t, k)); };
        const double *const a = corner(0), *const b = corner(1), *const c = corner(2);
        const auto column_of = [&](double x) { return first_column(x, frame.width()); };
        const auto row_of = [&](double y) { return first_column(y, frame.height()); };
        const int left = column_of(std::min({ a[0], b[0], c[0] })), right = column_of(std::max({ a[0], b[0], c[0] }));
        const int low = row_of(std::min({ a[1], b[1], c[1] })), high = row_of(std::max({ a[1], b[1], c[1] }));
        const double area = EdgeFunction(a, b, 1).at(c[0], c[1]), side = area > 0 ? 1 : -1;
        if (left == right || low == high || area == 0)
            continue;
        const EdgeFunction bc(b, c, side), ca(c, a, side), ab(a, b, side);
        const double nearest = std::min({ a[2], b[2], c[2] }), furthest = std::max({ a[2], b[2], c[2] });
        for (int y = low; y < high; ++y) {
            double of_a = bc.at(left + 0.5, y + 0.5), of_b = ca.at(left + 0.5, y + 0.5),
                   of_c = ab.at(left + 0.5, y + 0.5);
            for (int x = left; x < right; ++x, of_a += bc.step(), of_b += ca.step(), of_c += ab.step())
                if (std::min({ of_a, of_b, of_c }) >= -k_seam) {
                    const double depth = (of_a * a[2] + of_b * b[2] + of_c * c[2]) * side / area;
                    paint(std::size_t(y) * std::size_t(frame.width()) + std::size_t(x),
                          float(std::clamp(depth, nearest, furthest)), t, area > 0);
                }
        }
    }
}

}  // namespace garmentfit
