// SPDX-License-Identifier: GPL-3.0-or-later
#include "place_of_garment.h"

#include <algorithm>
#include <cmath>

#include "garmentfit/body_place.h"
#include "tuning.h"

namespace garmentfit {
namespace {

constexpr Eigen::Index k_corners_looked_at = 1000;  // derived: a share of 1 % is known to a third of it

double height_of(const Positions& body) { return body.col(1).maxCoeff() - body.col(1).minCoeff(); }

// A file of which the garment's middle is the origin says nothing of its place: clothes for the trunk lie round hips
// then, if the body's pelvis is the origin as well.
bool tells_place(const Positions& corners, double height)
{
    const Vec3 middle = (corners.colwise().maxCoeff() + corners.colwise().minCoeff()).transpose() / 2;
    return middle.norm() > k_told_place * height;
}

}  // namespace

std::vector<Vec3> body_shifts(const Positions& body, double pelvis)
{
    std::vector<Vec3> shifts { Vec3::Zero() };
    const double soles = body.col(1).minCoeff(), least = k_least_shift * height_of(body);
    for (const double height : { soles, pelvis })
        if (std::abs(height) > least)
            shifts.push_back({ 0, -height, 0 });
    return shifts;
}

Positions spread_corners(const TriangleMesh& garment)
{
    const auto corners = garment.triangles.reshaped();
    const Eigen::Index step = std::max<Eigen::Index>(1, corners.size() / k_corners_looked_at);
    Positions spread((corners.size() + step - 1) / step, 3);
    for (Eigen::Index i = 0; i < spread.rows(); ++i)
        spread.row(i) = garment.positions.row(corners(i * step));
    return spread;
}

BodySurface::BodySurface(const TriangleMesh& body) : height_(height_of(body.positions)), skin_(body), winding_(body) { }

BodyPlace BodySurface::place_of(const Positions& corners, const Vec3& shift, bool is_known) const
{
    const bool is_told = is_known || tells_place(corners, height_);
    int inside = 0, near = 0;
    for (const auto& corner : corners.rowwise()) {
        const Vec3 at = corner.transpose() - shift;
        inside += winding_(at) > 0.5;
        near += is_told && skin_.nearest_triangle_within(at, k_near_skin * height_);
    }
    const double all = double(std::max<Eigen::Index>(corners.rows(), 1));
    return { shift, inside / all, near / all };
}

bool lies_on_body(const TriangleMesh& garment, const TriangleMesh& body)
{
    if (body.triangles.rows() == 0 || garment.triangles.rows() == 0)
        return false;
    const Positions corners = spread_corners(garment);
    const double height = height_of(body.positions),
                 length = (corners.colwise().maxCoeff() - corners.colwise().minCoeff()).maxCoeff();
    const bool has_unit = length >= k_shortest_on_body * height && length <= k_longest_garment * height;
    if (!has_unit || !tells_place(corners, height))
        return false;
    const BodySurface surface(body);
    const double pelvis = body.positions.col(1).minCoeff() + k_pelvis_height * height;
    const std::vector<Vec3> shifts = body_shifts(body.positions, pelvis);
    return std::any_of(shifts.begin(), shifts.end(), [&](const Vec3& shift) {
        const BodyPlace place = surface.place_of(corners, shift, false);
        return place.near_share >= k_surely_near && place.inside_share <= k_most_inside_body;
    });
}

}  // namespace garmentfit
