// SPDX-License-Identifier: GPL-3.0-or-later
#include "coarse_body.h"

#include <algorithm>
#include <cmath>

#include <meshoptimizer.h>

#include "edge_distances.h"
#include "nearest.h"
#include "parallel.h"
#include "proximity.h"
#include "tuning.h"
#include "used_vertices.h"

namespace garmentfit {
namespace {

/// Triangles between fewer of the same vertices, by edges that collapse to one of their ends
/// [garland_1997_simplification].
Triangles simplify(const TriangleMesh& mesh)
{
    using Floats = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
    using Indices = Eigen::Matrix<unsigned, Eigen::Dynamic, 3, Eigen::RowMajor>;
    constexpr std::size_t k_indices = 6;  // derived: Euler, two triangles a vertex
    const Floats places = mesh.positions.cast<float>();
    const Indices given = mesh.triangles.cast<unsigned>();
    const std::size_t vertices = std::size_t(places.rows()), stride = sizeof(float) * 3;
    const std::size_t fewest = std::min(k_indices * k_coarse_body_vertices, std::size_t(given.size()));
    Indices left(given.rows(), 3);
    const std::size_t count = meshopt_simplify(
        left.data(), given.data(), std::size_t(given.size()), places.data(), vertices, stride, fewest,
        float(k_coarse_body_error / meshopt_simplifyScale(places.data(), vertices, stride)), 0, nullptr);
    return left.topRows(Eigen::Index(count / 3)).cast<int>();
}

/// Turns with the triangle: along its first side, its normal, and across both. Zero columns where it has no area.
Eigen::Matrix3d frame_of(const Vec3& a, const Vec3& b, const Vec3& c)
{
    const Vec3 along = (b - a).normalized(), normal = (b - a).cross(c - a).normalized();
    Eigen::Matrix3d result;
    result << along, normal, along.cross(normal);
    return result;
}

Vec3 corner(const Positions& positions, const Triangles& triangles, int triangle, int k)
{
    return positions.row(triangles(triangle, k));
}

Eigen::Matrix3d frame_of(const Positions& positions, const Triangles& triangles, int triangle)
{
    return frame_of(corner(positions, triangles, triangle, 0), corner(positions, triangles, triangle, 1),
                    corner(positions, triangles, triangle, 2));
}

std::vector<std::vector<int>> triangles_by_vertex(const TriangleMesh& mesh)
{
    std::vector<std::vector<int>> result(std::size_t(mesh.positions.rows()));
    for (int t = 0; t < mesh.triangles.rows(); ++t)
        for (const int v : mesh.triangles.row(t))
            result[std::size_t(v)].push_back(t);
    return result;
}

bool are_clear_of_body(const std::vector<WornGarment>& garments)
{
    return std::all_of(garments.begin(), garments.end(), [](const WornGarment& garment) {
        return garment.certificate.body_crossings == 0 && garment.certificate.vertices_inside == 0;
    });
}

}  // namespace

CoarseBody::CoarseBody(const Rig& rig, const BodyMesh& body) : given_(body.surface.positions)
{
    if (given_.rows() < k_fine_body)
        return;
    const Triangles left = simplify(body.surface);
    vertices_ = used_vertices(left);
    if (vertices_.empty() || double(vertices_.size()) > k_worth_coarsening * double(given_.rows()))
        return;
    coarse_.emplace(rig, body, vertices_, numbered_among(vertices_, left));
    const MeshTopology topology(body.surface.triangles, int(given_.rows()));
    EdgeDistances along_edges(given_, topology, INFINITY);
    along_edges.add(vertices_);
    const std::vector<std::vector<int>> round = triangles_by_vertex(coarse_->body.surface);
    const TriangleTree tree(coarse_->body.surface);
    bindings_.resize(std::size_t(given_.rows()), { 0, { 1, 0, 0 }, Vec3::Constant(INFINITY) });
    parallel_for(given_.rows(), [&](Eigen::Index v) {
        const Vec3 place = given_.row(v);
        Binding& binding = bindings_[std::size_t(v)];
        if (const int kept = along_edges.source_of(int(v)); kept >= 0)
            binding = bind(place, number_among(vertices_, kept), round);
        if (!(binding.offset.norm() < k_bound_beside))  // an island collapsed, or the way ended in a corner
            if (const auto nearest = tree.nearest_triangle(place))
                binding = bound_to(nearest->triangle, place);
        if (!binding.offset.allFinite())  // no triangle has an area
            binding.offset.setZero();
    });
}

// From the triangles round a vertex to ever nearer ones beside them: across a gap, another limb may be nearer, or a sheet
// that the body wears.
CoarseBody::Binding CoarseBody::bind(const Vec3& place, int from, const std::vector<std::vector<int>>& round) const
{
    Binding best { round[std::size_t(from)].front(), { 1, 0, 0 }, Vec3::Constant(INFINITY) };
    const auto find_nearer = [&](int vertex) {
        bool found = false;
        for (const int triangle : round[std::size_t(vertex)])
            if (const Binding other = bound_to(triangle, place); other.offset.norm() < best.offset.norm()) {
                best = other;
                found = true;
            }
        return found;
    };
    bool goes_on = find_nearer(from);
    while (goes_on) {
        goes_on = false;
        for (const int vertex : Eigen::RowVector3i(coarse_->body.surface.triangles.row(best.triangle)))
            goes_on |= find_nearer(vertex);
    }
    return best;
}

CoarseBody::Binding CoarseBody::bound_to(int triangle, const Vec3& place) const
{
    const auto& [positions, triangles] = coarse_->body.surface;
    const Corners corners { place, corner(positions, triangles, triangle, 0), corner(positions, triangles, triangle, 1),
                            corner(positions, triangles, triangle, 2) };
    const ClosestPoints at = closest_points(PairKind::vertex_face, corners);
    const Eigen::Matrix3d frame = frame_of(positions, triangles, triangle);
    if (frame.determinant() == 0)  // its neighbours have its edges
        return { triangle, { 1, 0, 0 }, Vec3::Constant(INFINITY) };
    return { triangle,
             { -at.weights[1], -at.weights[2], -at.weights[3] },
             frame.transpose() * separation(at.weights, corners) };
}

DressedBody CoarseBody::gather(DressedBody dressed) const
{
    if (dressed.body.rows() > 0)
        dressed.body = dressed.body(vertices_, Eigen::all).eval();
    return dressed;
}

Positions CoarseBody::place(const Positions& coarse, double height) const
{
    const Triangles& triangles = coarse_->body.surface.triangles;
    Positions result(given_.rows(), 3);
    parallel_for(given_.rows(), [&](Eigen::Index v) {
        const auto& [t, shares, offset] = bindings_[std::size_t(v)];
        Vec3 at = height * (frame_of(coarse, triangles, t) * offset);
        for (int k = 0; k < 3; ++k)
            at += shares[std::size_t(k)] * corner(coarse, triangles, t, k);
        result.row(v) = at;
    });
    result(vertices_, Eigen::all) = coarse;
    return result;
}

Positions CoarseBody::spread(const Positions& coarse) const
{
    return coarse == coarse_->body.surface.positions ? given_ : place(coarse, 1);
}

Positions CoarseBody::lay(const Positions& coarse) const { return place(coarse, 0); }

bool are_clear_of(const CoarseBody& coarse, const DressedBody& dressed)
{
    if (dressed.garments.empty())
        return true;
    const TriangleMesh body { dressed.body, coarse.body().surface.triangles };
    return dressed.body.rows() > 0
        && std::all_of(dressed.garments.begin(), dressed.garments.end(), [&](const WornGarment& garment) {
               return crossing_count({ garment.positions, garment.rest.triangles }, body) == 0;
           });
}

bool put_on_given(const CoarseBody& coarse, const Triangles& given, DressedBody& dressed)
{
    const Positions laid = coarse.lay(dressed.body);
    dressed.body = coarse.spread(dressed.body);
    certify_all(dressed.garments, { dressed.body, given });
    if (are_clear_of_body(dressed.garments))
        return true;
    dressed.body = laid;
    certify_all(dressed.garments, { dressed.body, given });
    return false;
}

bool put_on_given(const CoarseBody& coarse, const Triangles& given, RecoverFrame& frame, DressedBody dressed)
{
    dressed.body = std::move(frame.body);
    for (std::size_t i = 0; i < dressed.garments.size(); ++i)
        dressed.garments[i].positions = frame.garments[i];
    put_on_given(coarse, given, dressed);
    frame.body = std::move(dressed.body);
    return all_clean(dressed.garments);
}

}  // namespace garmentfit
