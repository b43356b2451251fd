// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/mesh.h"

#include <algorithm>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "closed_surface.h"
#include "garmentfit/error.h"
#include "garmentfit/number_text.h"
#include "named_vertices.h"
#include "stray_vertices.h"
#include "surface_measures.h"
#include "topology.h"
#include "tuning.h"
#include "used_vertices.h"
#include "warps.h"

namespace garmentfit {
namespace {

/// Exact predicates take for ever on triangles that span hundreds of powers of two.
void require_no_stray(const std::string& name, const Positions& positions, const Triangles& triangles)
{
    const std::vector<int> vertices = used_vertices(triangles);
    const UsualBox usual(positions, vertices);
    for (const int v : vertices)
        if (const double away = usual.away(positions.row(v)); !(away <= k_stray_reach))
            throw InvalidInput(ErrorCode::degenerate_mesh,
                               name + ": vertex " + std::to_string(v) + " lies " + rounded_text(away, 2)
                                   + " times as far away as the other vertices reach; remove it with its faces, or "
                                     "repair the file");
}

// unit: sizes of a mesh. Of the 16 digits of a coordinate, 5 are left so far away; a wrap keeps 3 off the surface.
constexpr double k_farthest_from_origin = 1e11;

/// What is as far away as its coordinates have digits is flat, and CGAL's wrap of it runs out of its arrays.
void require_digits(const std::string& name, const Positions& positions, const Triangles& triangles)
{
    Eigen::AlignedBox3d box;
    for (const int v : used_vertices(triangles))
        box.extend(Vec3(positions.row(v)));
    const double away = box.center().norm() / box.diagonal().norm();
    if (away > k_farthest_from_origin && !box.diagonal().isZero())
        throw InvalidInput(ErrorCode::degenerate_mesh,
                           name + ": it lies " + rounded_text(away, 2)
                               + " times its own size away from the origin, where coordinates have lost their digits; "
                                 "move it to the origin in the program that made it");
}

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
    require_no_stray(name, positions, triangles);
    require_digits(name, positions, triangles);
}

}  // namespace

BodyMesh make_body(const Positions& positions, const Triangles& triangles)
{
    BodyMesh body;
    body.surface = { gather_strays(positions, triangles), triangles };
    check("body", body.surface.positions, triangles);
    body.closed = close_surface(body.surface, body.repaired);
    return body;
}

GarmentMesh make_garment(const Positions& positions, const Triangles& triangles, const CornerUvs& uvs)
{
    GarmentMesh garment { gather_strays(positions, triangles), triangles, {} };
    check("garment", garment.positions, triangles);
    double area = 0;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        area += area_vector(garment.positions, triangles, f).norm();
    if (!(area > 0))
        throw InvalidInput(ErrorCode::degenerate_mesh,
                           "garment: all " + std::to_string(triangles.rows())
                               + " faces have no area; give another surface");
    garment.warps = warps_of(garment.positions, triangles, uvs);
    return garment;
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
