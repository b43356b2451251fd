// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/certificate.h"

#include <algorithm>
#include <cmath>

#include "contact.h"
#include "disjoint_sets.h"
#include "nearest.h"
#include "parallel.h"
#include "stretch.h"
#include "winding_number.h"

namespace garmentfit {
namespace {

// At one place is one vertex: seams of UV charts have two.
bool is_corner(const TriangleMesh& mesh, int triangle, const Eigen::RowVector3d& place)
{
    const auto corners = mesh.triangles.row(triangle);
    return mesh.positions.row(corners[0]) == place || mesh.positions.row(corners[1]) == place
        || mesh.positions.row(corners[2]) == place;
}

std::vector<Crossing> crossings(const TriangleMesh& a, const TriangleMesh& b, bool same)
{
    const auto edges = edges_of(a.triangles);
    const TriangleTree tree(b);
    std::vector<std::vector<int>> hits(edges.rows());
    parallel_for(edges.rows(), [&](Eigen::Index e) {
        const int i = edges(e, 0), j = edges(e, 1);
        const auto is_neighbour = [&](int f) {
            return same && (is_corner(b, f, a.positions.row(i)) || is_corner(b, f, a.positions.row(j)));
        };
        hits[e] = tree.met_by(a.positions.row(i), a.positions.row(j), is_neighbour);
    });
    std::vector<Crossing> result;
    for (Eigen::Index e = 0; e < edges.rows(); ++e)
        for (int f : hits[e])
            result.emplace_back(int(e), f);
    return result;
}

// Well inside both: what only touches there may come out of any rounding as crossing or as not.
bool surely_crosses(const TriangleMesh& mesh, const Contact::Edges& edges, const Crossing& crossing)
{
    constexpr double k_sure = 1e-7;  // in shares of the edge and of the triangle
    const auto corner = [&](int k) { return Vec3(mesh.positions.row(mesh.triangles(crossing.second, k))); };
    const Vec3 p = mesh.positions.row(edges(crossing.first, 0)), q = mesh.positions.row(edges(crossing.first, 1));
    const Vec3 normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
    const double along = (corner(0) - p).dot(normal) / (q - p).dot(normal);
    const Vec3 place = p + along * (q - p);
    const auto share = [&](int k) {
        const Vec3 from = corner((k + 1) % 3), to = corner((k + 2) % 3);
        return (to - from).cross(place - from).dot(normal) / normal.squaredNorm();
    };
    return along > k_sure && along < 1 - k_sure && std::min({ share(0), share(1), share(2) }) > k_sure;
}

/// What crosses now, by whether it did before, too; what only touched there did not.
struct SelfCrossings {
    std::vector<Crossing> kept;
    int fresh = 0;
};

SelfCrossings sorted_out(const TriangleMesh& before, const std::vector<Crossing>& crossed_before,
                         const TriangleMesh& now)
{
    const auto edges = edges_of(now.triangles);
    SelfCrossings result;
    for (const Crossing& crossing : self_crossings(now))
        if (std::binary_search(crossed_before.begin(), crossed_before.end(), crossing)
            && surely_crosses(before, edges, crossing))
            result.kept.push_back(crossing);
        else
            ++result.fresh;
    return result;
}

// Vertices that belong to a face; a stray one is no cloth.
std::vector<int> vertices_of(const Triangles& triangles)
{
    std::vector<int> result(triangles.data(), triangles.data() + triangles.size());
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

// Along an edge that does not cross the body the winding number stays the same: one evaluation serves a whole piece.
int vertices_inside(const TriangleMesh& body, const TriangleMesh& garment, const std::vector<Crossing>& through_body)
{
    const auto edges = edges_of(garment.triangles);
    std::vector<char> crosses(edges.rows(), 0);
    for (const auto& [e, f] : through_body)
        crosses[e] = 1;
    DisjointSets pieces(int(garment.positions.rows()));
    for (Eigen::Index e = 0; e < edges.rows(); ++e)
        if (!crosses[e])
            pieces.join(edges(e, 0), edges(e, 1));
    std::vector<int> size(garment.positions.rows(), 0), roots;
    for (int v : vertices_of(garment.triangles))
        if (size[pieces.root(v)]++ == 0)
            roots.push_back(pieces.root(v));
    std::vector<char> inside(size.size(), 0);
    parallel_for(roots.size(), [&](std::size_t i) {
        inside[roots[i]] = winding_number(body, garment.positions.row(roots[i])) > 0.5;
    });
    int count = 0;
    for (int r : roots)
        count += inside[r] ? size[r] : 0;
    return count;
}

// Vertex distances bound the gap from above; the contact search below that bound finds edges that come closer.
double min_distance(const TriangleMesh& a, const TriangleMesh& b)
{
    const TriangleTree tree(b);
    double bound = INFINITY;
    for (int v : vertices_of(a.triangles))
        bound = std::min(bound, tree.distance(a.positions.row(v)));
    if (!std::isfinite(bound))
        return bound;
    Positions x(a.positions.rows() + b.positions.rows(), 3);
    x << a.positions, b.positions;
    Contact contact(a.triangles, int(a.positions.rows()), b.triangles);
    contact.detect(x, Positions::Zero(x.rows(), 3), { 0, bound });
    for (const ContactPair& pair : contact.pairs())
        if (!pair.self)
            bound = std::min(bound, pair.at.distance);
    return bound;
}

}  // namespace

std::vector<Crossing> crossings(const TriangleMesh& a, const TriangleMesh& b) { return crossings(a, b, false); }

std::vector<Crossing> self_crossings(const TriangleMesh& mesh) { return crossings(mesh, mesh, true); }

int crossing_count(const TriangleMesh& a, const TriangleMesh& b)
{
    return int(crossings(a, b).size() + crossings(b, a).size());
}

Strain strain_of(const GarmentMesh& rest, const Positions& positions)
{
    std::vector<double> strains = stretches(rest, positions);
    for (double& strain : strains)
        strain = std::abs(strain);
    return { quantile(strains, 0.5), quantile(strains, 0.95), quantile(strains, 1) };
}

Certificate certify(const TriangleMesh& body, const GarmentMesh& rest, const Positions& positions,
                    const std::vector<TriangleMesh>& under)
{
    const TriangleMesh garment { positions, rest.triangles };
    const std::vector<Crossing> through_body = crossings(garment, body);
    Certificate result;
    result.body_crossings = int(through_body.size() + crossings(body, garment).size());
    const TriangleMesh given { rest.positions, rest.triangles };
    const std::vector<Crossing> crossed_before = self_crossings(given);
    result.input_self_crossings = int(crossed_before.size());
    SelfCrossings self = sorted_out(given, crossed_before, garment);
    result.self_crossings = self.fresh;
    result.kept_self_crossings = std::move(self.kept);
    for (const TriangleMesh& layer : under)
        result.layer_crossings += crossing_count(garment, layer);
    result.vertices_inside = vertices_inside(body, garment, through_body);
    result.min_distance = result.body_crossings > 0 ? 0 : min_distance(garment, body);
    result.strain = strain_of(rest, positions);
    return result;
}

}  // namespace garmentfit
