// SPDX-License-Identifier: GPL-3.0-or-later
#include "bend.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>

#include "segment.h"
#include "tuning.h"

namespace garmentfit {
namespace {

using namespace rig_tuning;

/// The row between `from` and `to` with the smallest sum of squared residuals: of the cuts from two straight bones, and
/// of the ratio of the bones from the usual one.
int find_bend_row(const Centreline& line, int from, int to, const Vec3& root, double usual_ratio, double size)
{
    int best = (from + to) / 2;
    double least = std::numeric_limits<double>::max();
    const double outlier = std::pow(k_outlier * size, 2);  // m^2
    for (int i = from + 1; i < to; ++i) {
        double squares = 0;
        for (int k = from; k <= to; ++k)
            squares += std::min(outlier,
                                k < i ? squared_distance_to_segment(line.points[k], root, line.points[i])
                                      : squared_distance_to_segment(line.points[k], line.points[i], line.points[to]));
        const double upper = (line.points[i] - root).norm(), lower = (line.points[to] - line.points[i]).norm();
        const double off_line = squares / (to - from + 1) / std::pow(k_straight_spread * size, 2);
        const double off_ratio = std::pow((upper / (upper + lower) - usual_ratio) / k_ratio_spread, 2);
        if (off_line + off_ratio < least) {
            least = off_line + off_ratio;
            best = i;
        }
    }
    return best;
}

struct StraightLine {
    Vec3 middle, direction;
};

/// Least squares fit to the centroids of the cuts between two rows.
StraightLine fit_line(const Centreline& line, int from, int to)
{
    StraightLine result { Vec3::Zero(), Vec3::Zero() };
    for (int i = from; i <= to; ++i)
        result.middle += line.points[i] / (to - from + 1);
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (int i = from; i <= to; ++i) {
        const Vec3 d = line.points[i] - result.middle;
        spread += d * d.transpose();
    }
    result.direction = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(2);
    if (result.direction.dot(line.points[to] - line.points[from]) < 0)
        result.direction = -result.direction;
    return result;
}

}  // namespace

Vec3 place_bend(const Centreline& line, int from, int to, const Vec3& root, double usual_ratio, double size)
{
    const int row = find_bend_row(line, from, to, root, usual_ratio, size);
    const int upper = row - from, lower = to - row;
    const Vec3 on_line = line.points[row];
    if (upper < k_fewest_cuts || lower < k_fewest_cuts)
        return on_line;
    const StraightLine a = fit_line(line, from + upper * k_trunk_tenths / 10, row - upper * k_bend_tenths / 10),
                       b = fit_line(line, row + lower * k_bend_tenths / 10, to);
    const double cosine = a.direction.dot(b.direction), angle = std::acos(std::clamp(cosine, -1.0, 1.0));
    const double share = std::clamp((angle - k_corner_from) / (k_corner_to - k_corner_from), 0.0, 1.0);
    if (share == 0)
        return on_line;
    // derived: the points of two lines that are nearest to each other
    const Vec3 between = b.middle - a.middle;
    const double squared_sine = 1 - cosine * cosine;
    const Vec3 on_a
        = a.middle + (between.dot(a.direction) - cosine * between.dot(b.direction)) / squared_sine * a.direction;
    const Vec3 on_b
        = b.middle + (cosine * between.dot(a.direction) - between.dot(b.direction)) / squared_sine * b.direction;
    const Vec3 corner = 0.5 * (on_a + on_b);
    if ((on_a - on_b).norm() > k_corner_gap * size || (corner - on_line).norm() > k_corner_reach * size)
        return on_line;
    return on_line + share * (corner - on_line);
}

}  // namespace garmentfit
