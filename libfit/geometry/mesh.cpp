// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/mesh.h"

#include <string>

#include "closed_surface.h"
#include "garmentfit/error.h"
#include "named_vertices.h"
#include "surface_measures.h"
#include "topology.h"

namespace garmentfit {
namespace {

void check(const char* what, const Positions& positions, const Triangles& triangles)
{
    const std::string name(what);
    if (triangles.rows() == 0)
        throw InvalidInput(ErrorCode::no_faces, name + ": no faces; give a surface mesh");
    for (Eigen::Index v = 0; v < positions.rows(); ++v)
        if (!positions.row(v).allFinite())
            throw InvalidInput(ErrorCode::not_finite,
                               name + ": vertex " + std::to_string(v) + " is not finite; repair the file");
    require_named_vertices(name, positions.rows(), triangles);
}

}  // namespace

BodyMesh make_body(const Positions& positions, const Triangles& triangles)
{
    check("body", positions, triangles);
    BodyMesh body;
    body.surface = { positions, triangles };
    body.closed = close_surface(body.surface, body.repaired);
    return body;
}

GarmentMesh make_garment(const Positions& positions, const Triangles& triangles)
{
    check("garment", positions, triangles);
    double area = 0;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        area += area_vector(positions, triangles, f).norm();
    if (!(area > 0))
        throw InvalidInput(ErrorCode::degenerate_mesh,
                           "garment: all " + std::to_string(triangles.rows())
                               + " faces have no area; give another surface");
    return { positions, triangles };
}

Positions vertex_normals(const Positions& positions, const Triangles& triangles)
{
    Positions normals = Positions::Zero(positions.rows(), 3);
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        const Vec3 n = area_vector(positions, triangles, f);
        for (int k = 0; k < 3; ++k)
            normals.row(triangles(f, k)) += n;
    }
    for (Eigen::Index v = 0; v < normals.rows(); ++v)
        if (const double length = normals.row(v).norm(); length > 0)
            normals.row(v) /= length;
    return normals;
}

Eigen::Matrix<int, Eigen::Dynamic, 2, Eigen::RowMajor> edges_of(const Triangles& triangles)
{
    return triangles.rows() == 0 ? Edges(0, 2) : MeshTopology(triangles, triangles.maxCoeff() + 1).edges();
}

}  // namespace garmentfit
