// SPDX-License-Identifier: GPL-3.0-or-later
#include "closed_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <unordered_map>
#include <vector>

#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/iterator.h>

#include "cgal_mesh.h"
#include "garmentfit/error.h"
#include "nearest.h"
#include "surface_measures.h"
#include "topology.h"
#include "tuning.h"
#include "used_vertices.h"
#include "winding_number.h"
#include "wrapped_surface.h"

namespace garmentfit {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

struct Soup {
    std::vector<CgalKernel::Point_3> points;
    std::vector<std::vector<std::size_t>> triangles;
};

/// Finds the first point given so far that lies within a distance.
class Welder {
public:
    explicit Welder(double distance) : distance_(std::max(distance, 1e-300)) { }  // unit: never 0

    std::size_t row(const Vec3& p, std::vector<CgalKernel::Point_3>& points)
    {
        const Cell corner = cell(p - Vec3::Constant(0.5 * cell_size()));
        for (int k = 0; k < 8; ++k)  // the eight cells nearest to p
            if (const auto found = rows_.find({ corner[0] + (k & 1), corner[1] + (k >> 1 & 1), corner[2] + (k >> 2) });
                found != rows_.end())
                for (const std::size_t row : found->second)
                    if ((Vec3(points[row].x(), points[row].y(), points[row].z()) - p).squaredNorm()
                        <= distance_ * distance_)
                        return row;
        rows_[cell(p)].push_back(points.size());
        points.emplace_back(p.x(), p.y(), p.z());
        return points.size() - 1;
    }

private:
    using Cell = std::array<long long, 3>;
    struct Hash {
        std::size_t operator()(const Cell& c) const
        {
            return std::size_t(c[0]) * 73856093u ^ std::size_t(c[1]) * 19349663u ^ std::size_t(c[2]) * 83492791u;
        }
    };

    double cell_size() const { return 2 * distance_; }
    Cell cell(const Vec3& p) const
    {
        return { std::llround(std::floor(p.x() / cell_size())), std::llround(std::floor(p.y() / cell_size())),
                 std::llround(std::floor(p.z() / cell_size())) };
    }

    double distance_;
    std::unordered_map<Cell, std::vector<std::size_t>, Hash> rows_;
};

/// Without vertices that no triangle has.
TriangleMesh drop_unused(const TriangleMesh& surface)
{
    const std::vector<int> used = used_vertices(surface.triangles);
    if (Eigen::Index(used.size()) == surface.positions.rows())
        return surface;
    return { surface.positions(used, Eigen::all), numbered_among(used, surface.triangles) };
}

/// Merges vertices within a distance. Drops triangles that lose a corner, and all but the first on the same corners.
Soup weld(const TriangleMesh& surface, double distance)
{
    Soup soup;
    Welder welder(distance);
    std::vector<std::size_t> row;
    for (Eigen::Index v = 0; v < surface.positions.rows(); ++v)
        row.push_back(welder.row(surface.positions.row(v), soup.points));
    std::vector<std::array<std::size_t, 4>> sorted;  // corners in rising order, then which triangle
    for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
        std::array<std::size_t, 4> corners { row[surface.triangles(f, 0)], row[surface.triangles(f, 1)],
                                             row[surface.triangles(f, 2)], std::size_t(f) };
        std::sort(corners.begin(), corners.begin() + 3);
        if (corners[0] != corners[1] && corners[1] != corners[2])
            sorted.push_back(corners);
    }
    std::sort(sorted.begin(), sorted.end());
    const auto same = [](const auto& a, const auto& b) { return std::equal(a.begin(), a.begin() + 3, b.begin()); };
    sorted.erase(std::unique(sorted.begin(), sorted.end(), same), sorted.end());
    for (const auto& corners : sorted) {
        const auto f = Eigen::Index(corners[3]);
        soup.triangles.push_back(
            { row[surface.triangles(f, 0)], row[surface.triangles(f, 1)], row[surface.triangles(f, 2)] });
    }
    return soup;
}

/// Of each side (topology.h) the opposite one; empty where an edge does not have exactly two sides that run in opposite
/// directions.
std::vector<int> across_edges(const Triangles& triangles, int vertices)
{
    const MeshTopology topology(triangles, vertices);
    std::vector<int> across(triangles.size());
    const auto from = [&](int side) { return triangles(side / 3, side % 3); };
    for (int side = 0; side < int(across.size()); ++side) {
        across[side] = topology.opposite(side);
        if (across[side] < 0 || from(across[side]) == from(side))
            return {};
    }
    return across;
}

/// Whether the triangles at each vertex are one fan, and all vertices have some.
bool has_one_fan_a_vertex(const TriangleMesh& surface, const std::vector<int>& across)
{
    std::vector<bool> seen(surface.positions.rows(), false);
    std::vector<bool> in_fan(across.size(), false);
    for (int corner = 0; corner < int(across.size()); ++corner) {
        if (in_fan[corner])
            continue;
        const int v = surface.triangles(corner / 3, corner % 3);
        if (seen[v])
            return false;
        seen[v] = true;
        for (int c = corner; !in_fan[c]; c = across[c / 3 * 3 + (c + 2) % 3])  // over the edge that ends at v
            in_fan[c] = true;
    }
    return std::find(seen.begin(), seen.end(), false) == seen.end();
}

bool is_one_piece(const std::vector<int>& across)
{
    std::vector<bool> reached(across.size() / 3, false);
    std::vector<int> front { 0 };
    reached[0] = true;
    for (std::size_t i = 0; i < front.size(); ++i)
        for (int k = 0; k < 3; ++k)
            if (const int next = across[3 * front[i] + k] / 3; !reached[next]) {
                reached[next] = true;
                front.push_back(next);
            }
    return front.size() == reached.size();
}

/// One piece, closed, a manifold, its faces all turned one way, every vertex used, not all of it shrunk to a point.
bool is_one_closed_manifold(const TriangleMesh& surface)
{
    const std::vector<int> across = across_edges(surface.triangles, int(surface.positions.rows()));
    return !across.empty() && has_one_fan_a_vertex(surface, across) && is_one_piece(across) && volume(surface) != 0;
}

/// A connected component.
struct Piece {
    std::size_t label = 0;
    Eigen::AlignedBox3d box;
    double volume = 0;  ///< m^3, about the middle of its box; an open sheet has almost none

    double size() const { return box.diagonal().norm() * std::cbrt(std::abs(volume)); }
};

constexpr const char* k_label = "f:piece";

/// Labels the faces by piece and returns the pieces, the largest first. Size is length times thickness, so that a body
/// comes before a floor or a block.
std::vector<Piece> label_pieces(CgalMesh& mesh)
{
    const auto labels = mesh.add_property_map<CgalMesh::Face_index, std::size_t>(k_label, 0).first;
    std::vector<Piece> pieces(pmp::connected_components(mesh, labels));
    const auto corner = [&](CgalMesh::Halfedge_index h) {
        const auto& p = mesh.point(mesh.target(h));
        return Vec3(p.x(), p.y(), p.z());
    };
    for (const auto h : mesh.halfedges())
        if (!mesh.is_border(h))
            pieces[labels[mesh.face(h)]].box.extend(corner(h));
    for (const auto face : mesh.faces()) {
        const auto h = mesh.halfedge(face);
        Piece& piece = pieces[labels[face]];
        const Vec3 o = piece.box.center(), a = corner(h) - o, b = corner(mesh.next(h)) - o;
        piece.volume += a.cross(b).dot(corner(mesh.prev(h)) - o) / 6;
    }
    for (std::size_t i = 0; i < pieces.size(); ++i)
        pieces[i].label = i;
    std::stable_sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.size() > b.size(); });
    return pieces;
}

CgalMesh keep_only(CgalMesh mesh, std::size_t label)
{
    const auto labels = mesh.property_map<CgalMesh::Face_index, std::size_t>(k_label)
                            .first;  // those of the copy; CGAL overwrites them
    pmp::keep_connected_components(mesh, std::vector<std::size_t> { label }, labels);
    mesh.collect_garbage();
    return mesh;
}

/// Whether most of a piece is inside the other one, as an inner wall or lungs are.
bool lies_within(const TriangleMesh& piece, const TriangleMesh& main)
{
    const Eigen::Index step = std::max<Eigen::Index>(1, piece.positions.rows() / k_piece_samples);
    int inside = 0, samples = 0;
    for (Eigen::Index v = 0; v < piece.positions.rows(); v += step, ++samples)
        inside += std::abs(winding_number(main, piece.positions.row(v))) > 0.5;
    return 2 * inside > samples;
}

/// The largest piece, and the size of the next one that lies beside it.
struct Body {
    CgalMesh mesh;
    double rival = 0;  ///< as a share of the size; 0: none but islands
};

Body main_body(CgalMesh mesh)
{
    const std::vector<Piece> pieces = label_pieces(mesh);
    if (pieces.empty() || pieces[0].size() == 0)
        return {};
    Body body { keep_only(mesh, pieces[0].label) };
    for (std::size_t i = 1; i < pieces.size() && body.rival == 0; ++i) {
        const double share = pieces[i].size() / pieces[0].size();
        if (share < k_largest_island)
            break;
        if (!lies_within(from_cgal(keep_only(mesh, pieces[i].label)), from_cgal(body.mesh)))
            body.rival = share;
    }
    return body;
}

/// @param delaunay  take edges from a Delaunay triangulation only, else from all pairs of vertices
/// @return whether a patch was found
bool patch_hole(CgalMesh& mesh, CgalMesh::Halfedge_index hole, bool delaunay)
{
    std::vector<CgalMesh::Face_index> patch;
    std::vector<CgalMesh::Vertex_index> added;
    pmp::triangulate_refine_and_fair_hole(
        mesh, hole, std::back_inserter(patch), std::back_inserter(added),
        pmp::parameters::use_delaunay_triangulation(delaunay).do_not_use_cubic_algorithm(delaunay));
    return !patch.empty();
}

/// Closes a hole by a fan of triangles from its border to its middle.
void close_by_fan(CgalMesh& mesh, CgalMesh::Halfedge_index hole)
{
    CgalKernel::Vector_3 sum = CGAL::NULL_VECTOR;
    const auto corners = CGAL::vertices_around_face(hole, mesh);
    for (const auto v : corners)
        sum = sum + (mesh.point(v) - CGAL::ORIGIN);
    const auto middle = CGAL::ORIGIN + sum / double(corners.size());
    CGAL::Euler::fill_hole(hole, mesh);
    mesh.point(mesh.target(CGAL::Euler::add_center_vertex(hole, mesh))) = middle;
}

void fill_holes(CgalMesh& mesh)
{
    std::vector<CgalMesh::Halfedge_index> holes;
    pmp::extract_boundary_cycles(mesh, std::back_inserter(holes));
    for (const auto hole : holes) {
        const std::size_t edges = CGAL::halfedges_around_face(hole, mesh).size();
        if (!patch_hole(mesh, hole, true)
            && !(edges < std::size_t(k_largest_cubic_hole) && patch_hole(mesh, hole, false)))
            close_by_fan(mesh, hole);
    }
}

/// Orients, stitches and fills. Empty when the body comes in parts.
CgalMesh close_soup(Soup soup)
{
    pmp::orient_polygon_soup(soup.points, soup.triangles);
    CgalMesh mesh;
    pmp::polygon_soup_to_polygon_mesh(soup.points, soup.triangles, mesh);
    pmp::stitch_borders(mesh);
    Body body = main_body(std::move(mesh));
    if (body.rival > 0)
        return {};
    fill_holes(body.mesh);
    return body.mesh;
}

bool is_solid(const CgalMesh& mesh)
{
    return mesh.number_of_faces() > 3 && CGAL::is_closed(mesh) && std::abs(pmp::volume(mesh)) > 0;
}

Body wrapped_body(const TriangleMesh& surface, double alpha, const std::function<void(std::size_t)>& watch = {})
{
    return main_body(to_cgal(wrap_surface(surface, alpha, k_wrap_offset, watch)));
}

/// Wraps a body in parts, wider and wider gaps until nothing large lies apart.
CgalMesh wrap_body(const TriangleMesh& surface)
{
    Body body = wrapped_body(surface, k_wrap_alpha);
    for (const double alpha : k_wide_wrap_alphas) {
        if (body.rival == 0)
            break;
        if (Body wider = wrapped_body(surface, alpha); wider.rival == 0)
            body = std::move(wider);
    }
    if (body.rival > 0)
        throw InvalidInput(ErrorCode::separate_pieces,
                           "body: it is in pieces that lie apart, the second "
                               + std::to_string(std::lround(100 * body.rival))
                               + "% the size of the first (an island has at most "
                               + std::to_string(std::lround(100 * k_largest_island)) + "%); give one human body");
    return std::move(body.mesh);
}

TriangleMesh orient_outwards(TriangleMesh mesh)
{
    if (volume(mesh) < 0)
        mesh.triangles.col(1).swap(mesh.triangles.col(2));
    return mesh;
}

/// Of samples of the surface, the share that lies in a closed one or near it, m.
double share_covered(const TriangleMesh& surface, const TriangleMesh& closed, double near)
{
    const TriangleTree tree(closed);
    const Eigen::Index step = std::max<Eigen::Index>(1, surface.triangles.rows() / k_cover_samples);
    double covered = 0, all = 0;
    for (Eigen::Index f = 0; f < surface.triangles.rows(); f += step) {
        const Vec3 middle = surface.positions(surface.triangles.row(f), Eigen::all).colwise().mean();
        const double weight = area_vector(surface.positions, surface.triangles, f).norm();
        all += weight;
        if (tree.distance(middle) < near || winding_number(closed, middle) > 0.5)
            covered += weight;
    }
    return all > 0 ? covered / all : 0;
}

}  // namespace

std::optional<TriangleMesh> join_parts(const TriangleMesh& surface, Gaps gaps, const Progress& progress)
{
    struct TooManyPoints { };
    const auto watch = [&](std::size_t points) {
        progress.at(double(points) / k_most_joined);
        if (points > k_most_joined)
            throw TooManyPoints();
    };
    const double near = k_cover_distance * diagonal(surface.positions);
    try {
        const CgalMesh mesh = wrapped_body(surface, gaps == Gaps::wide ? k_join_wide : k_join_narrow, watch).mesh;
        if (!is_solid(mesh))
            return {};
        TriangleMesh closed = orient_outwards(from_cgal(mesh));
        if (share_covered(surface, closed, near) > k_least_cover)
            return closed;
    } catch (const CGAL::Failure_exception&) {
        // another wrap may do
    } catch (const TooManyPoints&) {
        // what it wraps is no body in parts
    }
    return {};
}

TriangleMesh close_surface(const TriangleMesh& given, bool& repaired)
{
    const TriangleMesh surface = drop_unused(given);
    if (is_one_closed_manifold(surface)) {
        TriangleMesh result = orient_outwards(surface);
        repaired = result.triangles != given.triangles || result.positions.rows() != given.positions.rows();
        return result;
    }
    repaired = true;
    const double size = diagonal(surface.positions);
    if (weld(surface, k_weld_shares[0] * size).triangles.empty())
        throw InvalidInput(ErrorCode::degenerate_mesh,
                           "body: all " + std::to_string(surface.triangles.rows())
                               + " faces have no area; give another surface");
    try {
        for (const double share : k_weld_shares)
            if (const CgalMesh mesh = close_soup(weld(surface, share * size)); is_solid(mesh))
                return orient_outwards(from_cgal(mesh));
        if (const CgalMesh mesh = wrap_body(surface); is_solid(mesh))  // torn, or in parts
            return orient_outwards(from_cgal(mesh));
    } catch (const CGAL::Failure_exception&) {
        // the message below says it
    }
    throw InvalidInput(ErrorCode::degenerate_mesh,
                       "body: its " + std::to_string(surface.triangles.rows())
                           + " faces cannot be closed to a solid; close the mesh or remesh it as one surface");
}

}  // namespace garmentfit
