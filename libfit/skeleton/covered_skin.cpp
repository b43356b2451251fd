// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/covered_skin.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "crossing_tree.h"
#include "garmentfit/error.h"
#include "garmentfit/mesh.h"
#include "keyframes.h"
#include "parallel.h"
#include "skin_weights.h"
#include "surface_measures.h"
#include "topology.h"
#include "tuning.h"

namespace garmentfit {
namespace {

using namespace skeleton_tuning;

constexpr double k_lift = 1e-5;  // unit: share of the diagonal; a line of sight begins off the faces around its vertex

/// Evenly over the sphere: a Fibonacci lattice.
std::vector<Vec3> directions_of_sight()
{
    std::vector<Vec3> directions;
    for (int i = 0; i < k_lines_of_sight; ++i) {
        const double height = 1 - (2 * i + 1.0) / k_lines_of_sight, radius = std::sqrt(1 - height * height);
        const double turn = 2 * std::numbers::pi * i / std::numbers::phi;
        directions.emplace_back(radius * std::cos(turn), height, radius * std::sin(turn));
    }
    return directions;
}

/// Body and clothes in one pose, and what of the body is seen there.
class Sight {
public:
    Sight(const TriangleMesh& body, const TriangleMesh& cloth) :
        positions_(body.positions), normals_(vertex_normals(body.positions, body.triangles)), body_(body),
        cloth_(cloth), far_(2 * diagonal(body.positions))
    {
    }

    /// @param depth  m; cloth that lies this far under the skin covers it all the same
    bool is_seen(Eigen::Index vertex, double depth) const
    {
        const Vec3 normal = normals_.row(vertex), place = lifted(vertex);
        return !cloth_.is_met(place - depth * normal, place)
            && std::any_of(directions_.begin(), directions_.end(), [&](const Vec3& direction) {
                   const Vec3 end = place + far_ * direction;
                   return is_outwards(direction, normal) && !cloth_.is_met(place, end) && !body_.is_met(place, end);
               });
    }

    /// Whether cloth ends most lines of sight.
    bool is_under_cloth(Eigen::Index vertex) const
    {
        const Vec3 normal = normals_.row(vertex), place = lifted(vertex);
        int all = 0, ended = 0;
        for (const Vec3& direction : directions_)
            if (is_outwards(direction, normal)) {
                ++all;
                ended += cloth_.is_met(place, place + far_ * direction);
            }
        return 2 * ended > all;
    }

private:
    static bool is_outwards(const Vec3& direction, const Vec3& normal)
    {
        return direction.dot(normal) > k_least_sight_cosine;
    }
    Vec3 lifted(Eigen::Index vertex) const
    {
        return Vec3(positions_.row(vertex)) + k_lift * far_ * Vec3(normals_.row(vertex));
    }

    Positions positions_, normals_;
    CrossingTree body_, cloth_;
    double far_;
    std::vector<Vec3> directions_ = directions_of_sight();
};

TriangleMesh joined_clothes(const std::vector<SkinnedCloth>& clothes, const BoneTransforms& transforms)
{
    Eigen::Index vertices = 0, faces = 0;
    for (const SkinnedCloth& cloth : clothes) {
        vertices += cloth.surface.positions.rows();
        faces += cloth.surface.triangles.rows();
    }
    TriangleMesh all { Positions(vertices, 3), Triangles(faces, 3) };
    vertices = faces = 0;
    for (const SkinnedCloth& cloth : clothes) {
        const auto& [positions, triangles] = cloth.surface;
        all.positions.middleRows(vertices, positions.rows()) = blend_linearly(positions, cloth.weights, transforms);
        all.triangles.middleRows(faces, triangles.rows()) = triangles.array() + int(vertices);
        vertices += positions.rows();
        faces += triangles.rows();
    }
    return all;
}

/// How far under the skin of each vertex its own limb certainly goes on.
std::vector<double> depths_under_skin(const Rig& rig, const TriangleMesh& body)
{
    const auto radii = bone_radii(rig.skeleton, rig.weights, body.positions);
    std::vector<double> depths;
    for (const int bone : strongest_bones(rig.weights))
        depths.push_back(k_depth_under_skin * radii[std::size_t(bone)]);
    return depths;
}

/// Shows the skin along that which is seen, too: lines of sight are few, and poses between those of the set exist.
void add_margin(const TriangleMesh& body, std::vector<char>& is_covered)
{
    const Edges edges = edges_of(body.triangles);
    double length = 0;
    for (const auto& edge : edges.rowwise())
        length += (body.positions.row(edge[0]) - body.positions.row(edge[1])).norm();
    length /= double(std::max<Eigen::Index>(1, edges.rows()));
    const int rings = std::clamp(int(std::ceil(k_margin_of_sight * diagonal(body.positions) / length)), 1, 100);
    for (int ring = 0; ring < rings; ++ring) {
        const std::vector<char> before = is_covered;
        for (const auto& edge : edges.rowwise())
            for (int end = 0; end < 2; ++end)
                if (!before[std::size_t(edge[end])])
                    is_covered[std::size_t(edge[1 - end])] = 0;
    }
}

void require_rows(const Positions& positions, const SkinWeights& weights, const char* what)
{
    if (weights.weights.rows() != positions.rows())
        throw InvalidInput(ErrorCode::count_mismatch,
                           std::string("covered skin: ") + what + " has " + std::to_string(positions.rows())
                               + " vertices and " + std::to_string(weights.weights.rows())
                               + " rows of weights; give a row for each vertex");
}

}  // namespace

std::vector<char> find_covered_skin(const TriangleMesh& body, const Rig& rig, const std::vector<SkinnedCloth>& clothes)
{
    require_rows(body.positions, rig.weights, "the body");
    for (const SkinnedCloth& cloth : clothes)
        require_rows(cloth.surface.positions, cloth.weights, "a garment");

    const std::size_t count = std::size_t(body.positions.rows());
    std::vector<char> is_covered(count, 0);
    const Sight at_rest(body, joined_clothes(clothes, bone_transforms(rig.skeleton, Pose())));
    parallel_for(count, [&](std::size_t v) {
        is_covered[v] = !at_rest.is_seen(Eigen::Index(v), 0) && at_rest.is_under_cloth(Eigen::Index(v));
    });
    const std::vector<double> depths = depths_under_skin(rig, body);
    for (const Keyframe& key : keyframes_of(rig)) {
        const BoneTransforms transforms = bone_transforms(rig.skeleton, key.pose);
        const Sight sight({ blend_linearly(body.positions, rig.weights, transforms), body.triangles },
                          joined_clothes(clothes, transforms));
        parallel_for(
            count, [&](std::size_t v) { is_covered[v] = is_covered[v] && !sight.is_seen(Eigen::Index(v), depths[v]); });
    }
    add_margin(body, is_covered);
    return is_covered;
}

Triangles uncovered_faces(const Triangles& triangles, const std::vector<char>& is_covered)
{
    std::vector<Eigen::Index> kept;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        if (!(is_covered[std::size_t(triangles(f, 0))] && is_covered[std::size_t(triangles(f, 1))]
              && is_covered[std::size_t(triangles(f, 2))]))
            kept.push_back(f);
    return triangles(kept, Eigen::all);
}

}  // namespace garmentfit
