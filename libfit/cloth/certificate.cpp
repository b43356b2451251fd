// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/certificate.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "contact.h"
#include "disjoint_sets.h"
#include "exact_crossings.h"
#include "given_crossings.h"
#include "parallel.h"
#include "part_of_mesh.h"
#include "quantile.h"
#include "stretch.h"
#include "used_vertices.h"
#include "weld.h"
#include "winding_number.h"

namespace garmentfit {
namespace {

// derived: around a closed surface winding numbers are 0 or 1.
constexpr double k_inside = 0.5;
// unit: what is nearer to that is summed exactly; dipoles err by some hundredths at most.
constexpr double k_unsure = 0.25;

// unit: m; how far around a garment the body is looked at first. Garments touch their bodies.
constexpr double k_near = 0.02;
// unit: for fewer places the sum of all solid angles takes less time than its tree.
constexpr std::size_t k_few_places = 16;

/// A mesh with its edges and its tree, made once for all searches of a certificate.
struct IndexedMesh {
    const TriangleMesh& mesh;
    const Edges edges;
    const TriangleTree tree;

    explicit IndexedMesh(const TriangleMesh& m) : IndexedMesh(m, edges_of(m.triangles)) { }
    IndexedMesh(const TriangleMesh& m, const Edges& edges_of_m) : mesh(m), edges(edges_of_m), tree(m) { }
};

std::vector<Crossing> crossings(const IndexedMesh& a, const IndexedMesh& b)
{
    return find_crossings(a.mesh, a.edges, b.tree);
}

std::vector<Crossing> self_crossings(const IndexedMesh& a) { return find_self_crossings(a.mesh, a.edges, a.tree); }

// The winding number is the same along an edge that does not cross the body: one evaluation serves a whole piece.
// Files with a normal for each face have no common vertices, but vertices at one place.
int count_vertices_inside(const TriangleMesh& body, const IndexedMesh& garment,
                          const std::vector<Crossing>& through_body)
{
    const Edges& edges = garment.edges;
    std::vector<char> crosses(edges.rows(), 0);
    for (const auto& [e, f] : through_body)
        crosses[e] = 1;
    const Positions& positions = garment.mesh.positions;
    DisjointSets pieces(int(positions.rows()));
    for (Eigen::Index e = 0; e < edges.rows(); ++e)
        if (!crosses[e])
            pieces.join(edges(e, 0), edges(e, 1));
    const std::vector<int> used = used_vertices(garment.mesh.triangles);
    const Weld weld({ positions, garment.mesh.triangles });
    for (const int v : used)
        pieces.join(v, weld.given_vertex(weld.cloth_vertex(v)));
    std::vector<int> size(positions.rows(), 0), roots;
    for (int v : used)
        if (size[pieces.root(v)]++ == 0)
            roots.push_back(pieces.root(v));
    std::vector<char> inside(size.size(), 0);
    const std::optional<WindingNumber> about
        = roots.size() > k_few_places ? std::optional<WindingNumber>(body) : std::nullopt;
    parallel_for(roots.size(), [&](std::size_t i) {
        const Vec3 place = positions.row(roots[i]);
        double number = about ? (*about)(place) : k_inside;
        if (std::abs(number - k_inside) < k_unsure)
            number = winding_number(body, place);
        inside[roots[i]] = number > k_inside;
    });
    int count = 0;
    for (int r : roots)
        count += inside[r] ? size[r] : 0;
    return count;
}

// Distances of vertices bound the distance from above. The contact search below that bound finds edges that come
// closer.
double min_distance(const IndexedMesh& garment, const IndexedMesh& body)
{
    const TriangleMesh &a = garment.mesh, &b = body.mesh;
    double bound = INFINITY;
    for (int v : used_vertices(a.triangles))
        bound = std::min(bound, body.tree.distance(a.positions.row(v)));
    if (!std::isfinite(bound))
        return bound;
    Positions x(a.positions.rows() + b.positions.rows(), 3);
    x << a.positions, b.positions;
    const int body_vertices = int(b.positions.rows());
    ContactDetector detector({ a.triangles, garment.edges, int(a.positions.rows()) },
                             { b.triangles, body.edges, body_vertices }, body_vertices);
    detector.detect(x, Positions::Zero(x.rows(), 3), { 0, bound });
    for (const ContactPair& pair : detector.pairs())
        if (pair.reason != ContactReason::self)
            bound = std::min(bound, pair.at.distance);
    return bound;
}

}  // namespace

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
    const TriangleMesh worn { positions, rest.triangles }, given { rest.positions, rest.triangles };
    const Box around = box_of(positions);
    const TriangleMesh near = part_in(body, { around.min().array() - k_near, around.max().array() + k_near });
    const IndexedMesh garment(worn), obstacle(near);
    const std::vector<Crossing> through_body = crossings(garment, obstacle);
    Certificate result;
    result.body_crossings = int(through_body.size() + crossings(obstacle, garment).size());
    const std::vector<Crossing> crossed_before = self_crossings(IndexedMesh(given, garment.edges));
    result.input_self_crossings = int(crossed_before.size());
    ComparedCrossings self
        = GivenCrossings(given, garment.edges, crossed_before).compare(positions, self_crossings(garment));
    result.self_crossings = int(self.fresh.size());
    result.shifted_self_crossings = int(self.shifted.size());
    result.kept_self_crossings = std::move(self.kept);
    for (const TriangleMesh& mesh : under) {
        const IndexedMesh layer(mesh);
        result.layer_crossings += int(crossings(garment, layer).size() + crossings(layer, garment).size());
    }
    result.vertices_inside = count_vertices_inside(body, garment, through_body);
    result.min_distance = result.body_crossings > 0 ? 0 : min_distance(garment, obstacle);
    if (result.min_distance > k_near)  // what is nearer may lie outside
        result.min_distance = min_distance(garment, IndexedMesh(body));
    result.strain = strain_of(rest, positions);
    return result;
}

}  // namespace garmentfit
