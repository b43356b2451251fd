// SPDX-License-Identifier: GPL-3.0-or-later
#include "decimated_surface.h"

#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include "cgal_mesh.h"

namespace fit {

TriangleMesh decimated_surface(const TriangleMesh& closed, int vertices)
{
    if (closed.positions.rows() <= vertices)
        return closed;
    namespace sms = CGAL::Surface_mesh_simplification;
    CgalMesh mesh = to_cgal(closed);
    const sms::Count_stop_predicate<CgalMesh> stop(3 * std::size_t(vertices));  // Euler: three edges a vertex
    sms::edge_collapse(mesh, stop);
    mesh.collect_garbage();
    return from_cgal(mesh);
}

}  // namespace fit
