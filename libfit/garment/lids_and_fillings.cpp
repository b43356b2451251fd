// SPDX-License-Identifier: GPL-3.0-or-later
#include "lids_and_fillings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <numbers>
#include <numeric>
#include <set>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "disjoint_sets.h"
#include "garmentfit/mesh.h"
#include "nearest.h"
#include "panel.h"
#include "surface_measures.h"
#include "tuning.h"
#include "used_vertices.h"

namespace garmentfit {
namespace {

using namespace garment_tuning;

constexpr double k_no_length = 1e-300;  // m, unit: avoids 0 / 0

Eigen::AlignedBox3d box_of(const TriangleMesh& mesh, const std::vector<int>& faces)
{
    Eigen::AlignedBox3d box;
    for (const int f : faces)
        for (const int v : mesh.triangles.row(f))
            box.extend(Vec3(mesh.positions.row(v)));
    return box;
}

/// The faces of the cloth without some of them.
std::vector<int> other_faces(std::vector<char> is_cloth, const std::vector<int>& faces)
{
    for (const int f : faces)
        is_cloth[f] = 0;
    std::vector<int> others;
    for (int f = 0; f < int(is_cloth.size()); ++f)
        if (is_cloth[f])
            others.push_back(f);
    return others;
}

/// Whether no edge is open and there is no tunnel, by the Euler characteristic of a sphere.
bool is_solid(const TriangleMesh& mesh, const MeshTopology& topology, const std::vector<int>& faces)
{
    std::set<int> vertices;
    for (const int f : faces)
        for (int k = 0; k < 3; ++k) {
            if (topology.opposite(3 * f + k) < 0)
                return false;
            vertices.insert(mesh.triangles(f, k));
        }
    return 2 * std::ptrdiff_t(vertices.size()) - std::ptrdiff_t(faces.size()) == 4;  // derived: 3 sides a face
}

/// With patches that have corners in one cell of a grid as one piece: where edges have more than two faces, or each
/// face has corners of its own, each face is a patch.
std::vector<std::vector<int>> joined_where_near(const TriangleMesh& mesh, const std::vector<std::vector<int>>& patches,
                                                double cell)
{
    DisjointSets same(int(patches.size()));
    std::map<std::array<double, 3>, int> first;  // patch in each cell
    for (int p = 0; p < int(patches.size()); ++p)
        for (const int f : patches[p])
            for (const int v : mesh.triangles.row(f)) {
                const Vec3 at = (mesh.positions.row(v) / cell).array().floor();
                same.join(first.try_emplace({ at.x(), at.y(), at.z() }, p).first->second, p);
            }
    std::vector<std::vector<int>> pieces;
    for (const std::vector<int>& group : same.groups()) {
        std::vector<int>& piece = pieces.emplace_back();
        for (const int p : group)
            piece.insert(piece.end(), patches[p].begin(), patches[p].end());
    }
    return pieces;
}

// ---- lids ----------------------------------------------------------------------------------------------------------

/// The middle of points, and their principal axes; they spread least along the first.
struct Frame {
    Eigen::RowVector3d mean;
    Eigen::Matrix3d axes;
};

Frame frame_of(const Positions& points)
{
    const Eigen::RowVector3d mean = points.colwise().mean();
    const Positions about = points.rowwise() - mean;
    return { mean, Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(about.transpose() * about).eigenvectors() };
}

/// A patch as it lies in its own plane.
struct Disc {
    Vec3 centre, normal;
    Eigen::Vector2d half;  // m, extents in its plane, the longer one first
    double depth;  // m, across
    double cover;  // its area, seen along the normal, as a share of the rectangle around it
    Positions rim;  // vertices that are not in its middle
};

Disc disc_of(const TriangleMesh& mesh, const std::vector<int>& faces, bool is_slab)
{
    std::set<int> used;
    for (const int f : faces)
        used.insert(mesh.triangles.row(f).begin(), mesh.triangles.row(f).end());
    const Positions points = mesh.positions(std::vector<int>(used.begin(), used.end()), Eigen::all);
    const auto [mean, axes] = frame_of(points);
    const Eigen::Matrix<double, Eigen::Dynamic, 3> along = (points.rowwise() - mean) * axes;
    const Eigen::RowVector3d low = along.colwise().minCoeff(), high = along.colwise().maxCoeff();
    Disc disc;
    disc.centre = mean.transpose() + axes * (0.5 * (low + high)).transpose();
    disc.normal = axes.col(0);
    disc.half = { 0.5 * (high[2] - low[2]), 0.5 * (high[1] - low[1]) };
    disc.depth = high[0] - low[0];
    double area = 0;
    for (const int f : faces)
        area += std::abs(area_vector(mesh.positions, mesh.triangles, f).dot(disc.normal));
    disc.cover = area / (is_slab ? 2 : 1) / std::max(4 * disc.half.prod(), k_no_length);
    std::vector<int> outer;
    for (int v = 0; v < int(along.rows()); ++v)
        if (Eigen::Vector2d((along(v, 2) - 0.5 * (low[2] + high[2])) / disc.half[0],
                            (along(v, 1) - 0.5 * (low[1] + high[1])) / disc.half[1])
                .norm()
            > k_lid_rim)
            outer.push_back(v);
    disc.rim = points(outer, Eigen::all);
    return disc;
}

/// As flat, round and wide as a lid of a cuff.
/// @param depth  the largest, as a share of the mean of the half extents
bool has_shape_of_lid(const Disc& disc, double smallest_girth, double depth)
{
    const double size = std::sqrt(disc.half.prod());
    return disc.half[1] > k_lid_roundness * disc.half[0] && disc.depth < depth * size
        && 2 * std::numbers::pi * size > smallest_girth && disc.cover > k_lid_cover && disc.rim.rows() > 0;
}

/// Whether it spans an opening of the cloth around it.
/// @param others  faces of the cloth around it
bool spans_opening(const TriangleMesh& mesh, const std::vector<int>& others, const Disc& disc)
{
    const TriangleMesh around { mesh.positions, mesh.triangles(others, Eigen::all) };
    const TriangleTree cloth(around);
    if (!(cloth.distance(disc.centre) > k_lid_middle * disc.half[1]))  // a pocket, a label
        return false;
    const double reach = k_lid_reach * std::sqrt(disc.half.prod());
    int near = 0;
    for (const auto& point : disc.rim.rowwise())
        near += cloth.distance(point) < reach;
    if (near < k_lid_outline * double(disc.rim.rows()))
        return false;
    const NearestPoint rim(disc.rim);
    double all = 0, steep = 0;  // m^2
    for (int f = 0; f < int(around.triangles.rows()); ++f) {
        const Vec3 middle = around.positions(around.triangles.row(f), Eigen::all).colwise().mean();
        if (rim.distance(middle) > 2 * reach)
            continue;
        const Vec3 area = area_vector(around.positions, around.triangles, f);
        all += area.norm();
        if (std::abs(area.dot(disc.normal)) < std::sqrt(1 - k_steep_sine * k_steep_sine) * area.norm())
            steep += area.norm();
    }
    return steep > k_lid_steep * all;
}

/// Every so many-th one.
std::vector<int> spread_among(const std::vector<int>& vertices)
{
    constexpr std::size_t k_many = 500;  // unit: bounds the work on patches that lie amid the others
    std::vector<int> result;
    for (std::size_t i = 0; i < vertices.size(); i += 1 + vertices.size() / k_many)
        result.push_back(vertices[i]);
    return result;
}

/// Whether vertices beside a patch's own lie on both sides of a plane.
bool are_on_both_sides(const Positions& positions, const std::vector<int>& vertices, const std::vector<int>& own,
                       const Frame& plane)
{
    bool any_above = false, any_below = false;
    for (const int v : vertices) {
        if (std::binary_search(own.begin(), own.end(), v))
            continue;
        const double height = (positions.row(v) - plane.mean).dot(plane.axes.col(0));
        (height > 0 ? any_above : any_below) = true;
        if (any_above && any_below)
            return true;
    }
    return false;
}

/// Whether all else lies on one side of a flat patch, apart from it, and is not much larger along it: the floor below a
/// garment, or its shadow. Nothing holds it.
/// @param all  used vertices of the mesh
/// @param probes  some of them, from everywhere. There may be thousands of flat patches: most lie amid the others
bool is_floor(const TriangleMesh& mesh, const std::vector<int>& all, const std::vector<int>& probes,
              const std::vector<int>& patch)
{
    const std::vector<int> own = used_vertices(mesh.triangles(patch, Eigen::all));
    const Positions flat = mesh.positions(own, Eigen::all);
    const Frame frame = frame_of(flat);
    if (are_on_both_sides(mesh.positions, probes, own, frame) || are_on_both_sides(mesh.positions, all, own, frame))
        return false;
    std::vector<int> rest;
    std::set_difference(all.begin(), all.end(), own.begin(), own.end(), std::back_inserter(rest));
    if (rest.empty())
        return false;
    const Positions others = (mesh.positions(rest, Eigen::all).rowwise() - frame.mean) * frame.axes,
                    along = (flat.rowwise() - frame.mean) * frame.axes;
    const auto length = [](const Positions& positions, int axis) {
        return positions.col(axis).maxCoeff() - positions.col(axis).minCoeff();
    };
    const double gap = k_floor_gap * diagonal(others);
    return (others.col(0).minCoeff() > gap || others.col(0).maxCoeff() < -gap)
        && length(along, 1) > k_floor_size * length(others, 1) && length(along, 2) > k_floor_size * length(others, 2);
}

}  // namespace

std::vector<std::vector<int>> patches_of(const MeshTopology& topology, int faces)
{
    DisjointSets joined(faces);
    for (int side = 0; side < 3 * faces; ++side)
        if (const int other = topology.opposite(side); other > side)
            joined.join(side / 3, other / 3);
    return joined.groups();
}

bool is_without_inner_vertices(const MeshTopology& topology, const std::vector<int>& disc)
{
    const std::set<int> own(disc.begin(), disc.end());
    std::size_t inner = 0;
    for (const int f : disc)
        for (int side = 3 * f; side < 3 * f + 3; ++side)
            if (const int other = topology.opposite(side); other >= 0)
                inner += own.count(other / 3);
    return inner == 2 * (disc.size() - 1);
}

std::vector<std::vector<int>> find_fillings(const TriangleMesh& mesh, const MeshTopology& topology,
                                            const std::vector<std::vector<int>>& patches,
                                            const std::vector<int>& closed_ends)
{
    const double least = k_filling
        * Eigen::AlignedBox3d(Vec3(mesh.positions.colwise().minCoeff()), Vec3(mesh.positions.colwise().maxCoeff()))
              .volume(),
                 margin = k_filling_margin * diagonal(mesh.positions);
    std::vector<std::size_t> inner_first(patches.size());  // of shells in each other, the outermost is left
    std::iota(inner_first.begin(), inner_first.end(), std::size_t(0));
    std::stable_sort(inner_first.begin(), inner_first.end(), [&](std::size_t a, std::size_t b) {
        return box_of(mesh, patches[a]).volume() < box_of(mesh, patches[b]).volume();
    });
    std::vector<char> is_cloth(std::size_t(mesh.triangles.rows()), 1);
    std::vector<std::vector<int>> fillings;
    for (const std::size_t p : inner_first) {
        if (closed_ends[p] >= int(k_least_ends) || !is_solid(mesh, topology, patches[p]))
            continue;
        const TriangleMesh solid { mesh.positions, mesh.triangles(patches[p], Eigen::all) };
        const double enclosed = std::abs(volume(solid)), around = area(solid);
        if (enclosed < least || is_panel(thickness_of(enclosed, around), around))
            continue;
        Eigen::AlignedBox3d rest = box_of(mesh, other_faces(is_cloth, patches[p]));
        if (rest.isEmpty())
            continue;
        rest.extend(rest.min() - Vec3::Constant(margin)).extend(rest.max() + Vec3::Constant(margin));
        if (!rest.contains(box_of(mesh, patches[p])))
            continue;
        for (const int f : patches[p])
            is_cloth[f] = 0;
        fillings.push_back(patches[p]);
    }
    std::sort(fillings.begin(), fillings.end());
    return fillings;
}

std::vector<std::vector<int>> find_specks(const TriangleMesh& mesh, const std::vector<std::vector<int>>& patches)
{
    Eigen::AlignedBox3d all;
    for (const std::vector<int>& patch : patches)
        all.extend(box_of(mesh, patch));
    const double whole = all.isEmpty() ? 0 : all.diagonal().norm();
    const auto is_small
        = [&](const std::vector<int>& piece) { return box_of(mesh, piece).diagonal().norm() < k_speck_size * whole; };
    if (std::none_of(patches.begin(), patches.end(), is_small))
        return {};
    std::vector<std::vector<int>> small;
    std::vector<int> large;
    for (std::vector<int>& piece : joined_where_near(mesh, patches, k_speck_gap * whole / 4))
        if (is_small(piece))
            small.push_back(std::move(piece));
        else
            large.insert(large.end(), piece.begin(), piece.end());
    if (small.empty() || large.empty())
        return {};
    const TriangleMesh cloth { mesh.positions, mesh.triangles(large, Eigen::all) };
    const TriangleTree tree(cloth);
    std::erase_if(small, [&](const std::vector<int>& patch) {
        const Eigen::AlignedBox3d box = box_of(mesh, patch);
        const double length = box.diagonal().norm(), gap = tree.distance(box.center()) - length / 2;
        return gap < std::max(length, k_speck_gap * whole);
    });
    return small;
}

std::vector<std::vector<int>> find_backdrops(const TriangleMesh& mesh, const std::vector<std::vector<int>>& patches)
{
    std::vector<std::vector<int>> flat, backdrops;
    Eigen::AlignedBox3d others;
    for (const std::vector<int>& patch : patches) {
        const std::vector<int> used = used_vertices(mesh.triangles(patch, Eigen::all));
        if (is_flat(mesh.positions(used, Eigen::all), k_flat_backdrop))
            flat.push_back(patch);
        else
            others.extend(box_of(mesh, patch));
    }
    if (others.isEmpty())
        return {};
    const std::vector<int> all = used_vertices(mesh.triangles), probes = spread_among(all);
    std::vector<std::vector<int>> floors;
    for (const std::vector<int>& patch : flat)
        if (box_of(mesh, patch).diagonal().norm() >= k_backdrop_size * others.diagonal().norm())
            backdrops.push_back(patch);
        else if (is_floor(mesh, all, probes, patch))
            floors.push_back(patch);
    if (backdrops.empty() && floors.size() == 1)  // more are panels that lie round a body
        return floors;
    return backdrops;
}

std::vector<std::vector<int>> find_lids(const TriangleMesh& mesh, const MeshTopology& topology,
                                        const std::vector<std::vector<int>>& patches, const std::vector<char>& is_cloth)
{
    const double smallest_girth = k_cap_girth * diagonal(mesh.positions);
    std::vector<std::vector<int>> lids;
    for (const std::vector<int>& patch : patches) {
        if (patches.size() < 2 || !is_cloth[patch[0]])
            continue;
        const Disc disc = disc_of(mesh, patch, is_solid(mesh, topology, patch));
        const bool is_filling = patch.size() >= k_fan_faces && is_without_inner_vertices(topology, patch);
        if (has_shape_of_lid(disc, smallest_girth, is_filling ? k_filled_lid_depth : k_lid_depth)
            && spans_opening(mesh, other_faces(is_cloth, patch), disc))
            lids.push_back(patch);
    }
    return lids;
}

}  // namespace garmentfit
