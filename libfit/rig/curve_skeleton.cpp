// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve_skeleton.h"

#include <cmath>

#include "ordered_memory.h"

// The flow collapses edges in the order of a std::set of handles, which compares addresses. OrderedAllocator gives its
// mesh ascending addresses, so that results are reproducible.
#include <CGAL/memory.h>
#undef CGAL_ALLOCATOR
#define CGAL_ALLOCATOR(T) garmentfit::OrderedAllocator<T>
#include <CGAL/Polyhedron_3_fwd.h>
#undef CGAL_ALLOCATOR
#define CGAL_ALLOCATOR(T) std::allocator<T>

#define CGAL_EIGEN3_ENABLED
#include <CGAL/Mean_curvature_flow_skeletonization.h>
#include <CGAL/Polygon_mesh_processing/measure.h>

#include "cgal_mesh.h"
#include "garmentfit/error.h"

namespace garmentfit {
namespace {

using Flow = CGAL::Mean_curvature_flow_skeletonization<CgalMesh>;

constexpr int k_most_steps = 200;  // unit: a body needs 20 to 40
constexpr std::size_t k_bytes_a_vertex
    = 8192;  // unit: address space for the splits of the flow, reserved and not touched
constexpr double k_still_fraction = 1e-4;  // unit: share of the area; converged when a step changes it by less

void contract(Flow& flow, double area, const Progress& progress)
{
    double before = area;
    for (int step = 0; step < k_most_steps; ++step) {
        progress.at(step / (step + 20.0));  // unit: display only
        flow.contract();
        const double now = CGAL::Polygon_mesh_processing::area(flow.meso_skeleton());
        if (!std::isfinite(now))
            throw InvalidInput(ErrorCode::not_human,
                               "body: its surface does not contract to a skeleton (step " + std::to_string(step)
                                   + " is not finite); remesh it with triangles of similar size");
        if (std::abs(before - now) < k_still_fraction * area)
            return;
        before = now;
    }
}

CurveSkeleton from_cgal(const Flow::Skeleton& graph, std::size_t vertices)
{
    CurveSkeleton result;
    result.node_of_vertex.assign(vertices, -1);
    for (const auto node : CGAL::make_range(boost::vertices(graph))) {
        const auto& p = graph[node].point;
        for (const auto vertex : graph[node].vertices)
            result.node_of_vertex[vertex] = int(result.nodes.size());
        result.nodes.emplace_back(p.x(), p.y(), p.z());
    }
    for (const auto& edge : CGAL::make_range(boost::edges(graph)))
        result.edges.push_back({ int(boost::source(edge, graph)), int(boost::target(edge, graph)) });
    return result;
}

}  // namespace

CurveSkeleton curve_skeleton(const TriangleMesh& closed, const Progress& progress)
{
    const CgalMesh mesh = to_cgal(closed);
    const OrderedMemory memory(k_bytes_a_vertex * mesh.number_of_vertices());
    try {
        Flow flow(mesh);
        contract(flow, CGAL::Polygon_mesh_processing::area(mesh), progress);
        Flow::Skeleton graph;
        flow.convert_to_skeleton(graph);
        return from_cgal(graph, closed.positions.rows());
    } catch (const CGAL::Failure_exception& failure) {
        throw InvalidInput(ErrorCode::not_human,
                           std::string("body: its surface does not contract to a skeleton (") + failure.expression()
                               + "); remesh it with triangles of similar size");
    }
}

}  // namespace garmentfit
