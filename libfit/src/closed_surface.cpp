// SPDX-License-Identifier: GPL-3.0-or-later
#include "closed_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include "cgal_mesh.h"
#include "fit/error.h"
#include "wrapped_surface.h"

namespace fit {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;

constexpr double k_weld = 1e-6;            // of the diagonal: on a body, 2 micrometres
constexpr double k_main_share = 0.5;       // of the area: with less, the body comes in parts
constexpr int k_most_holes = 200;          // more than this is a surface in tatters

struct Soup {
    std::vector<CgalKernel::Point_3> points;
    std::vector<std::vector<std::size_t>> triangles;
};

double diagonal(const TriangleMesh& surface)
{
    return (surface.positions.colwise().maxCoeff() - surface.positions.colwise().minCoeff()).norm();
}

/// Vertices that lie at one place become one; triangles that lose a corner go.
Soup welded(const TriangleMesh& surface)
{
    const double cell = k_weld * diagonal(surface);
    Soup soup;
    std::map<std::array<long long, 3>, std::size_t> place;
    std::vector<std::size_t> row(surface.positions.rows());
    for (Eigen::Index v = 0; v < surface.positions.rows(); ++v) {
        const auto p = surface.positions.row(v);
        const auto [found, is_new] = place.try_emplace({ std::llround(p.x() / cell), std::llround(p.y() / cell),
                                                         std::llround(p.z() / cell) }, soup.points.size());
        if (is_new)
            soup.points.emplace_back(p.x(), p.y(), p.z());
        row[v] = found->second;
    }
    for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
        const std::size_t a = row[surface.triangles(f, 0)], b = row[surface.triangles(f, 1)], c = row[surface.triangles(f, 2)];
        if (a != b && b != c && c != a)
            soup.triangles.push_back({ a, b, c });
    }
    return soup;
}

/// One piece, closed, a manifold, its faces all turned one way, every vertex used, not all of it shrunk to a point.
bool is_one_closed_manifold(const TriangleMesh& surface)
{
    std::vector<std::vector<std::size_t>> triangles;
    std::vector<bool> used(surface.positions.rows(), false);
    for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
        triangles.push_back({ std::size_t(surface.triangles(f, 0)), std::size_t(surface.triangles(f, 1)),
                              std::size_t(surface.triangles(f, 2)) });
        for (const std::size_t v : triangles.back())
            used[v] = true;
    }
    if (std::find(used.begin(), used.end(), false) != used.end() || !pmp::is_polygon_soup_a_polygon_mesh(triangles))
        return false;
    CgalMesh mesh = to_cgal(surface);
    if (pmp::area(mesh) == 0)
        return false;
    const auto labels = mesh.add_property_map<CgalMesh::Face_index, std::size_t>("f:component", 0).first;
    return CGAL::is_closed(mesh) && pmp::connected_components(mesh, labels) == 1;
}

/// Keeps the largest component; returns its share of the area.
double keep_main_part(CgalMesh& mesh)
{
    if (mesh.number_of_faces() == 0)
        return 0;
    const double whole = pmp::area(mesh);
    const auto labels = mesh.add_property_map<CgalMesh::Face_index, std::size_t>("f:component", 0).first;
    std::vector<double> areas(pmp::connected_components(mesh, labels), 0.0);
    for (const auto face : mesh.faces())
        areas[labels[face]] += pmp::face_area(face, mesh);
    const std::size_t main = std::max_element(areas.begin(), areas.end()) - areas.begin();
    pmp::keep_connected_components(mesh, std::vector<std::size_t> { main }, labels);
    mesh.collect_garbage();
    return areas[main] / whole;
}

void fill_holes(CgalMesh& mesh)
{
    std::vector<CgalMesh::Halfedge_index> holes;
    pmp::extract_boundary_cycles(mesh, std::back_inserter(holes));
    if (holes.size() > k_most_holes)
        return;
    std::vector<CgalMesh::Face_index> patch;
    for (const auto hole : holes)
        pmp::triangulate_hole(mesh, hole, std::back_inserter(patch), pmp::parameters::do_not_use_cubic_algorithm(true));
}

CgalMesh closed_soup(Soup soup)
{
    pmp::orient_polygon_soup(soup.points, soup.triangles);
    CgalMesh mesh;
    pmp::polygon_soup_to_polygon_mesh(soup.points, soup.triangles, mesh);
    pmp::stitch_borders(mesh);
    if (keep_main_part(mesh) < k_main_share)
        return {};
    fill_holes(mesh);
    return mesh;
}

bool is_solid(const CgalMesh& mesh)
{
    return mesh.number_of_faces() > 3 && CGAL::is_closed(mesh) && std::abs(pmp::volume(mesh)) > 0;
}

TriangleMesh outward(TriangleMesh mesh)
{
    if (pmp::volume(to_cgal(mesh)) < 0)
        mesh.triangles.col(1).swap(mesh.triangles.col(2));
    return mesh;
}

}  // namespace

TriangleMesh closed_surface(const TriangleMesh& surface, bool& repaired)
{
    if (is_one_closed_manifold(surface)) {
        TriangleMesh result = outward(surface);
        repaired = result.triangles != surface.triangles;
        return result;
    }
    repaired = true;
    const Soup soup = welded(surface);
    if (soup.triangles.empty())
        throw InvalidInput("body: all " + std::to_string(surface.triangles.rows()) + " faces are degenerate; give a surface with area");
    try {
        CgalMesh mesh = closed_soup(soup);
        if (!is_solid(mesh)) {  // in tatters or in parts
            mesh = to_cgal(wrapped_surface(surface));
            keep_main_part(mesh);
        }
        if (is_solid(mesh))
            return outward(from_cgal(mesh));
    } catch (const CGAL::Failure_exception&) {
        // told below, in the user's words
    }
    throw InvalidInput("body: its " + std::to_string(surface.triangles.rows())
                       + " faces cannot be closed to a solid; close the mesh or remesh it as one surface");
}

}  // namespace fit
