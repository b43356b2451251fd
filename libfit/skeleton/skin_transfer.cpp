// SPDX-License-Identifier: GPL-3.0-or-later
#include "skin_transfer.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include <flann/flann.hpp>

#include "disjoint_sets.h"
#include "loose_vertices.h"
#include "nearest.h"
#include "parallel.h"
#include "skin_weights.h"
#include "surface_measures.h"
#include "tuning.h"
#include "weld.h"

namespace garmentfit {
namespace {

using namespace skeleton_tuning;

constexpr int k_block = 4096;  // unit: vertices of one parallel task, no influence on results
constexpr double k_same_place = 1e-12;  // unit: share of the squared diagonal, avoids 1 / 0 at the very place
// derived: steps from forearm to ribs, which are far apart. At the crotch thigh meets thigh, but both are one step from
// the hips. Held by SkinTransfer.NothingIsStrayWhereBonesFollowEachOther.
constexpr int k_far_bones = 3;

/// Rows (position, weighted normal): points that are near in this space are near and have similar normals.
using OrientedPoints = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;

OrientedPoints oriented_points(const Positions& positions, const Positions& normals, double normal_length)
{
    OrientedPoints rows(positions.rows(), 6);
    rows << positions, normal_length * normals;
    return rows;
}

/// The user's faces may have any orientation if the mesh was repaired. Then the nearest points of the closed surface
/// have the outward normals.
Positions outward_normals(const BodyMesh& body, const Positions& places)
{
    if (!body.repaired)
        return vertex_normals(body.surface.positions, body.surface.triangles);
    const Positions closed = vertex_normals(body.closed.positions, body.closed.triangles);
    const NearestPoint nearest(body.closed.positions);
    Positions normals(places.rows(), 3);
    for (Eigen::Index v = 0; v < normals.rows(); ++v)
        normals.row(v) = closed.row(nearest.index(places.row(v)));
    return normals;
}

/// The bone with the largest weight of each row.
std::vector<int> main_bones(const Eigen::MatrixXd& weights)
{
    std::vector<int> bones(weights.rows());
    for (Eigen::Index v = 0; v < weights.rows(); ++v)
        weights.row(v).maxCoeff(&bones[v]);
    return bones;
}

using BoneSteps = std::array<std::array<int, bone_count>, bone_count>;

/// Number of steps along the skeleton between bones by the Floyd-Warshall algorithm. Bones of one parent are
/// neighbours, also those at the root.
BoneSteps bone_steps()
{
    BoneSteps steps;
    for (int a = 0; a < bone_count; ++a)
        for (int b = 0; b < bone_count; ++b)
            steps[a][b] = a == b                         ? 0
                : parent_of(a) == b || parent_of(b) == a ? 1
                : parent_of(a) == parent_of(b)           ? 1
                                                         : bone_count;
    for (int middle = 0; middle < bone_count; ++middle)
        for (auto& from : steps)
            for (int to = 0; to < bone_count; ++to)
                from[to] = std::min(from[to], from[middle] + steps[middle][to]);
    return steps;
}

int steps_between(int bone, int other)
{
    static const BoneSteps steps = bone_steps();
    return steps[bone][other];
}

/// Weights interpolated from the nearest points by inverse squared distance. Points count only if their main bone is
/// near, along the skeleton, to that of the nearest point: fingertips that touch do not share weights.
class BlendedWeights {
public:
    BlendedWeights(OrientedPoints points, Eigen::MatrixXd weights) :
        points_(std::move(points)), weights_(std::move(weights)), bones_(main_bones(weights_)),
        same_place_(k_same_place * (points_.colwise().maxCoeff() - points_.colwise().minCoeff()).squaredNorm()),
        neighbours_(std::min<int>(k_neighbours, int(points_.rows()))),
        tree_(flann::Matrix<double>(points_.data(), points_.rows(), 6), flann::KDTreeSingleIndexParams())
    {
        tree_.buildIndex();
    }

    Eigen::MatrixXd at(OrientedPoints queries) const
    {
        const std::size_t n = queries.rows();
        Eigen::MatrixXd blended(n, bone_count);
        parallel_for((n + k_block - 1) / k_block, [&](std::size_t block) {
            const std::size_t first = block * k_block, count = std::min<std::size_t>(k_block, n - first);
            interpolate(queries.data() + 6 * first, blended.middleRows(first, count));
        });
        return blended;
    }

private:
    void interpolate(double* queries, Eigen::Ref<Eigen::MatrixXd> blended) const
    {
        const std::size_t count = blended.rows();
        std::vector<int> rows(count * neighbours_);
        std::vector<double> squared(count * neighbours_);
        flann::Matrix<int> found(rows.data(), count, neighbours_);
        flann::Matrix<double> distances(squared.data(), count, neighbours_);
        tree_.knnSearch(flann::Matrix<double>(queries, count, 6), found, distances, neighbours_,
                        flann::SearchParams(-1));
        for (std::size_t v = 0; v < count; ++v) {
            Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(bone_count);
            const int* const near = rows.data() + v * neighbours_;
            for (int k = 0; k < neighbours_; ++k)
                if (steps_between(bones_[near[0]], bones_[near[k]]) < k_far_bones)
                    row += weights_.row(near[k]) / (squared[v * neighbours_ + k] + same_place_);
            blended.row(v) = row;
        }
    }

    OrientedPoints points_;
    Eigen::MatrixXd weights_;
    std::vector<int> bones_;
    double same_place_;  // m^2
    int neighbours_;
    flann::Index<flann::L2<double>> tree_;
};

template <typename Visit>
void for_each_edge(const Triangles& triangles, Visit&& visit)
{
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k)
            visit(triangles(f, k), triangles(f, (k + 1) % 3));
}

/// For each vertex one that stands for it and those at its place that are one with it, as files with hard edges have a
/// vertex for each corner of a face. Where more than two triangles meet at an edge, shells touch, and stay apart.
std::vector<int> sewn_vertices(const TriangleMesh& surface)
{
    const Weld weld(GarmentMesh { surface.positions, surface.triangles });
    DisjointSets sewn(weld.given());
    std::vector<std::array<int, 4>> sides;  // two places, two vertices
    for_each_edge(surface.triangles, [&](int a, int b) {
        if (weld.cloth_vertex(a) > weld.cloth_vertex(b))
            std::swap(a, b);
        sides.push_back({ weld.cloth_vertex(a), weld.cloth_vertex(b), a, b });
    });
    std::sort(sides.begin(), sides.end());
    const auto is_at = [&](std::size_t i, const std::array<int, 4>& side) {
        return i < sides.size() && sides[i][0] == side[0] && sides[i][1] == side[1];
    };
    for (std::size_t i = 0; i < sides.size();) {
        std::size_t next = i + 1;
        while (is_at(next, sides[i]))
            ++next;
        if (next - i == 2)
            for (const int end : { 2, 3 })
                sewn.join(sides[i][end], sides[i + 1][end]);
        i = next;
    }
    std::vector<int> result(std::size_t(weld.given()));
    for (int v = 0; v < weld.given(); ++v)
        result[v] = sewn.root(v);
    return result;
}

Triangles with_corners(Triangles triangles, const std::vector<int>& vertices)
{
    for (int& corner : triangles.reshaped())
        corner = vertices[corner];
    return triangles;
}

/// Vertices outside the largest part of their surface, after cuts along edges where bones far apart meet.
std::vector<bool> find_separated(const Triangles& triangles, const std::vector<int>& bone_of_vertex)
{
    const int n = int(bone_of_vertex.size());
    DisjointSets parts(n), surfaces(n);
    for_each_edge(triangles, [&](int a, int b) {
        surfaces.join(a, b);
        if (steps_between(bone_of_vertex[a], bone_of_vertex[b]) < k_far_bones)
            parts.join(a, b);
    });
    std::vector<int> size(n, 0), largest(n, -1);
    for (int v = 0; v < n; ++v)
        ++size[parts.root(v)];
    for (int v = 0; v < n; ++v) {
        int& best = largest[surfaces.root(v)];
        if (best < 0 || size[parts.root(v)] > size[best])
            best = parts.root(v);
    }
    std::vector<bool> result(n);
    for (int v = 0; v < n; ++v)
        result[v] = parts.root(v) != largest[surfaces.root(v)];
    return result;
}

/// Interpolation from those points only whose main bone is one of `bones`; from all points if there are none.
BlendedWeights weights_on(const std::array<bool, bone_count>& bones, const std::vector<int>& bone_of_vertex,
                          const OrientedPoints& points, const Eigen::MatrixXd& weights)
{
    std::vector<int> rows;
    for (int v = 0; v < int(bone_of_vertex.size()); ++v)
        if (bones[bone_of_vertex[v]])
            rows.push_back(v);
    if (rows.empty())
        return { points, weights };
    return { points(rows, Eigen::all), weights(rows, Eigen::all) };
}

}  // namespace

std::vector<StrayPatch> stray_patches(const Triangles& triangles, const std::vector<int>& bone_of_vertex)
{
    const std::vector<bool> stray = find_separated(triangles, bone_of_vertex);
    DisjointSets joined(int(bone_of_vertex.size()));
    for_each_edge(triangles, [&](int a, int b) {
        if (stray[a] && stray[b])
            joined.join(a, b);
    });
    std::map<int, StrayPatch> patches;
    for (int v = 0; v < int(stray.size()); ++v)
        if (stray[v])
            patches[joined.root(v)].vertices.push_back(v);
    for_each_edge(triangles, [&](int a, int b) {
        if (stray[a] == stray[b])
            return;
        const int around = bone_of_vertex[stray[a] ? b : a];
        for (int bone = 0; bone < bone_count; ++bone)
            patches[joined.root(stray[a] ? a : b)].near_bones[bone] |= steps_between(bone, around) <= 1;
    });
    std::vector<StrayPatch> result;
    for (auto& [root, patch] : patches)
        result.push_back(std::move(patch));
    return result;
}

SkinWeights transfer_skin_weights(const TriangleMesh& from, const Eigen::MatrixXd& weights, const BodyMesh& to)
{
    const double normal_length = k_normal_weight * diagonal(from.positions);
    const OrientedPoints points
        = oriented_points(from.positions, vertex_normals(from.positions, from.triangles), normal_length);
    const Positions places = move_to_stumps(to);
    const OrientedPoints queries = oriented_points(places, outward_normals(to, places), normal_length);

    Eigen::MatrixXd transferred = BlendedWeights(points, weights).at(queries);
    const std::vector<int> bone_of_point = main_bones(weights);
    const std::vector<int> sewn = sewn_vertices({ places, to.surface.triangles });
    for (const StrayPatch& patch : stray_patches(with_corners(to.surface.triangles, sewn), main_bones(transferred)))
        transferred(patch.vertices, Eigen::all)
            = weights_on(patch.near_bones, bone_of_point, points, weights).at(queries(patch.vertices, Eigen::all));
    transferred = Eigen::MatrixXd(transferred(sewn, Eigen::all));
    return strongest_four(std::move(transferred));
}

}  // namespace garmentfit
