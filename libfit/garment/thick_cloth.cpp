// SPDX-License-Identifier: GPL-3.0-or-later
#include "thick_cloth.h"

#include <cstddef>

#include "disjoint_sets.h"
#include "panel.h"
#include "surface_measures.h"

namespace garmentfit {

std::vector<char> mark_thick_cloth(const TriangleMesh& mesh, const MeshTopology& topology)
{
    struct Piece {
        double volume = 0, area = 0;  // m^3, m^2
        int faces = 0, vertices = 0;
        bool is_closed = true;
    };
    DisjointSets joined(int(mesh.positions.rows()));
    for (const auto& corners : mesh.triangles.rowwise())
        for (int k = 0; k < 2; ++k)
            joined.join(corners[k], corners[k + 1]);
    std::vector<Piece> pieces(std::size_t(mesh.positions.rows()));  // by the root
    double area = 0;
    for (int v = 0; v < int(mesh.positions.rows()); ++v)
        ++pieces[joined.root(v)].vertices;
    for (int f = 0; f < int(mesh.triangles.rows()); ++f) {
        Piece& piece = pieces[joined.root(mesh.triangles(f, 0))];
        const Vec3 from = mesh.positions.row(joined.root(mesh.triangles(f, 0)));
        const Vec3 face = area_vector(mesh.positions, mesh.triangles, f);
        piece.volume += face.dot(Vec3(mesh.positions.row(mesh.triangles(f, 0))) - from) / 3;
        piece.area += face.norm();
        ++piece.faces;
        area += face.norm();
    }
    for (const int edge : topology.border_edges())
        pieces[joined.root(topology.edges()(edge, 0))].is_closed = false;
    std::vector<char> result;
    for (int f = 0; f < int(mesh.triangles.rows()); ++f) {
        const Piece& piece = pieces[joined.root(mesh.triangles(f, 0))];
        const bool has_tunnels = 2 * piece.vertices - piece.faces <= 0;
        result.push_back(piece.is_closed && (has_tunnels || piece.area < area / 2)
                         && is_panel(thickness_of(piece.volume, piece.area), piece.area));
    }
    return result;
}

}  // namespace garmentfit
