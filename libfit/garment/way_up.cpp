// SPDX-License-Identifier: GPL-3.0-or-later
#include "way_up.h"
#include "garmentfit/garment_up.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>

#include <Eigen/Eigenvalues>

#include "outward_cloth.h"
#include "posture.h"
#include "tuning.h"
#include "type_guess.h"

namespace garmentfit {
namespace {

using namespace garment_tuning;

constexpr double k_no_area = 1e-300;  // m^2, unit: avoids 0 / 0

/// Principal axes of the cloth's area, largest first.
std::vector<Vec3> principal_axes(const TriangleMesh& cloth)
{
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
    Vec3 first = Vec3::Zero();
    double area = 0;
    for (Eigen::Index f = 0; f < cloth.triangles.rows(); ++f) {
        const Vec3 a = cloth.positions.row(cloth.triangles(f, 0)), b = cloth.positions.row(cloth.triangles(f, 1)),
                   c = cloth.positions.row(cloth.triangles(f, 2));
        const double weight = 0.5 * (b - a).cross(c - a).norm();
        const Vec3 middle = (a + b + c) / 3;
        area += weight;
        first += weight * middle;
        second += weight * middle * middle.transpose();
    }
    const Vec3 mean = first / std::max(area, k_no_area);
    const Eigen::Matrix3d axes
        = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(second - area * mean * mean.transpose()).eigenvectors();
    return { axes.col(2), axes.col(1), axes.col(0) };
}

/// Whether two openings are two sleeves or two legs, independent of the vertical.
bool are_twins(const Opening& a, const Opening& b)
{
    return a.piece == b.piece && std::max(a.girth, b.girth) < k_twin_girths * std::min(a.girth, b.girth)
        && std::max(a.tube_girth, b.tube_girth) < k_twin_girths * std::min(a.tube_girth, b.tube_girth)
        && face_alike(a, b, (b.centre - a.centre).stableNormalized())
        && (b.centre - a.centre).norm() > k_twin_distance * a.girth;
}

/// Largest distance between two openings, m.
double spread(const std::vector<Opening>& openings)
{
    double largest = 0;
    for (const Opening& a : openings)
        for (const Opening& b : openings)
            largest = std::max(largest, (a.centre - b.centre).norm());
    return largest;
}

struct Middles {
    std::vector<Vec3> points;  // of openings, and of pairs
    Vec3 across = Vec3::Zero();  // between the pair that is farthest apart
};

/// @param openings  of one piece
Middles collect_middles(const std::vector<Opening>& openings)
{
    Middles middles;
    for (std::size_t i = 0; i < openings.size(); ++i) {
        middles.points.push_back(openings[i].centre);
        for (std::size_t j = i + 1; j < openings.size(); ++j)
            if (are_twins(openings[i], openings[j])) {
                middles.points.push_back(0.5 * (openings[i].centre + openings[j].centre));
                const Vec3 across = openings[j].centre - openings[i].centre;
                if (across.norm() > middles.across.norm())
                    middles.across = across;
            }
    }
    return middles;
}

/// Lines between middles, in the plane of symmetry: from hem to neck, from between the legs to the waist. Short lines
/// are no evidence and are left out.
std::vector<Vec3> lines_along(const std::vector<Opening>& openings)
{
    const Middles middles = collect_middles(openings);
    const Vec3 across = middles.across.stableNormalized();
    const double least = k_long_line * spread(openings);
    std::vector<Vec3> lines;
    for (std::size_t i = 0; i < middles.points.size(); ++i)
        for (std::size_t j = i + 1; j < middles.points.size(); ++j) {
            const Vec3 line = middles.points[j] - middles.points[i], level = line - line.dot(across) * across;
            if (level.norm() > least && level.norm() > k_line_across * line.norm())
                lines.push_back(level);
        }
    std::stable_sort(lines.begin(), lines.end(), [](const Vec3& a, const Vec3& b) { return a.norm() > b.norm(); });
    return lines;
}

std::vector<Vec3> lines_along_pieces(const std::vector<Opening>& openings)
{
    std::map<int, std::vector<Opening>> pieces;
    for (const Opening& opening : openings)
        pieces[opening.piece].push_back(opening);
    std::vector<Vec3> lines;
    for (const auto& [name, piece] : pieces)
        for (const Vec3& line : lines_along(piece))
            lines.push_back(line.normalized());
    return lines;
}

std::vector<Vec3> both_ways(const std::vector<Vec3>& lines)
{
    std::vector<Vec3> result;
    for (const Vec3& line : lines)
        result.insert(result.end(), { line, -line });
    return result;
}

std::vector<Vec3> coordinate_axes() { return both_ways({ Vec3::UnitY(), Vec3::UnitX(), Vec3::UnitZ() }); }

/// Keeps the first of directions that are close to each other.
std::vector<Vec3> keep_distinct(const std::vector<Vec3>& directions)
{
    std::vector<Vec3> kept;
    for (const Vec3& one : directions)
        if (std::none_of(kept.begin(), kept.end(),
                         [&](const Vec3& other) { return angle_between(one, other) < k_apart; }))
            kept.push_back(one);
    return kept;
}

/// Most garments are given along the coordinate axes; their cut makes their measured axes deviate a little.
Vec3 snap_to_axes(const Vec3& direction)
{
    for (const Vec3& axis : coordinate_axes())
        if (angle_between(axis, direction) < k_nearly_along)
            return axis;
    return direction;
}

double angle_to_nearest(const std::vector<Vec3>& lines, const Vec3& up)
{
    double least = lines.empty() ? 0 : k_most_askew;
    for (const Vec3& line : both_ways(lines))
        least = std::min(least, angle_between(line, up));
    return least;
}

std::vector<Vec3> list_candidates(const TriangleMesh& outward, std::vector<Vec3> lines)
{
    if (lines.empty())  // for example a jacket that is open from neck to hem
        lines = principal_axes(outward);
    std::vector<Vec3> ups = both_ways(lines);
    std::transform(ups.begin(), ups.end(), ups.begin(), snap_to_axes);
    std::stable_partition(ups.begin(), ups.end(), [](const Vec3& up) { return up == Vec3::UnitY(); });
    return keep_distinct(ups);
}

double uprightness_turned(const TriangleMesh& outward, const std::vector<Opening>& openings,
                          const Eigen::Quaterniond& turn)
{
    return uprightness(rotate(openings, rotate(outward, turn), turn));
}

/// The evidence of a rotation minus the evidence of the same upside down.
WayUp score_rotation(const Vec3& up, const TriangleMesh& outward, const std::vector<Opening>& openings,
                     const std::vector<Vec3>& lines)
{
    const Eigen::Quaterniond turn = shortest_arc(up, Vec3::UnitY()),
                             over(Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitX()));
    return { turn, uprightness_turned(outward, openings, turn) - uprightness_turned(outward, openings, over * turn),
             angle_to_nearest(lines, up) };
}

}  // namespace

std::vector<WayUp> ways_up(const TriangleMesh& outward, const std::vector<Opening>& openings)
{
    const std::vector<Vec3> lines = lines_along_pieces(openings), ups = list_candidates(outward, lines);
    const WayUp given = score_rotation(Vec3::UnitY(), outward, openings, lines);
    if (given.evidence > 0 && !ups.empty() && ups[0] == Vec3::UnitY())
        return { given };

    std::vector<Vec3> all = coordinate_axes();
    all.insert(all.end(), ups.begin(), ups.end());
    std::vector<WayUp> ways;
    for (const Vec3& up : keep_distinct(all))
        ways.push_back(score_rotation(up, outward, openings, lines));
    std::stable_sort(ways.begin(), ways.end(), [](const WayUp& a, const WayUp& b) { return a.evidence > b.evidence; });
    return ways;
}

std::vector<double> evidence_for_up(const GarmentMesh& garment, const std::vector<Vec3>& ups)
{
    const TriangleMesh outward = outward_cloth(garment);
    const std::vector<Opening> openings = openings_of(outward);
    std::vector<double> evidence;
    for (const Vec3& up : ups)
        evidence.push_back(openings.empty() ? 0 : score_rotation(up, outward, openings, {}).evidence);
    return evidence;
}

}  // namespace garmentfit
