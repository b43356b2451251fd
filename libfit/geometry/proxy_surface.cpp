// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy_surface.h"

#include <vector>

#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include "cgal_mesh.h"
#include "short_edges.h"
#include "topology.h"
#include "tuning.h"

namespace garmentfit {
namespace {

namespace sms = CGAL::Surface_mesh_simplification;

using Stop = sms::Count_stop_predicate<CgalMesh>;

/// Cuts each triangle into four at the middles of its edges.
TriangleMesh quarter(const TriangleMesh& mesh)
{
    const MeshTopology topology(mesh.triangles, int(mesh.positions.rows()));
    std::vector<int> middle_of(topology.edges().rows(), -1);
    std::vector<Vec3> points;
    for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v)
        points.push_back(mesh.positions.row(v));
    const auto middle = [&](Eigen::Index f, int k) {
        int& found = middle_of[topology.edge_of(int(3 * f) + k)];
        if (found < 0) {
            found = int(points.size());
            points.push_back(0.5 * (points[mesh.triangles(f, k)] + points[mesh.triangles(f, (k + 1) % 3)]));
        }
        return found;
    };
    TriangleMesh result;
    result.triangles.resize(4 * mesh.triangles.rows(), 3);
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
        const int a = mesh.triangles(f, 0), b = mesh.triangles(f, 1), c = mesh.triangles(f, 2);
        const int ab = middle(f, 0), bc = middle(f, 1), ca = middle(f, 2);
        result.triangles.middleRows<4>(4 * f) << a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca;
    }
    result.positions.resize(points.size(), 3);
    for (std::size_t v = 0; v < points.size(); ++v)
        result.positions.row(v) = points[v];
    return result;
}

TriangleMesh decimate(const TriangleMesh& closed, int vertices)
{
    const int coarse = k_coarse_multiple * vertices;
    CgalMesh mesh = to_cgal(closed.positions.rows() > coarse ? collapse_short_edges(closed, coarse) : closed);
    sms::edge_collapse(mesh, Stop(3 * std::size_t(vertices)));  // derived: Euler, three edges a vertex
    mesh.collect_garbage();
    return from_cgal(mesh);
}

}  // namespace

TriangleMesh proxy_surface(const TriangleMesh& closed, int vertices)
{
    if (closed.positions.rows() > vertices)
        return decimate(closed, vertices);
    TriangleMesh proxy = closed;
    while (double(proxy.positions.rows()) < k_fewest_proxy_vertices
               * vertices)  // not decimated afterwards, which would undo it where the surface is flat
        proxy = quarter(proxy);
    return proxy;
}

}  // namespace garmentfit
