// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "parallel.h"
#include "segment.h"
#include "tuning.h"
#include "used_vertices.h"

namespace garmentfit {
namespace {

std::uint64_t make_key(int i, int j) { return (std::uint64_t(std::uint32_t(i)) << 32) | std::uint32_t(j); }

// Of the vertices first to last of a pair.
double largest(const Eigen::VectorXd& values, const std::array<int, 4>& v, int first, int last)
{
    double result = values[v[first]];
    for (int k = first + 1; k < last; ++k)
        result = std::max(result, values[v[k]]);
    return result;
}

bool share_a_vertex(const std::array<int, 4>& v, int split)
{
    for (int i = 0; i < split; ++i)
        for (int j = split; j < 4; ++j)
            if (v[i] == v[j])
                return true;
    return false;
}

// How much nearer two primitives can come when each vertex goes any fraction of its path. Whatever the fractions are,
// the separation changes by a mean of single paths and of differences of two of them.
double approach_bound(const Positions& paths, const std::array<int, 4>& v, int split)
{
    double square = 0;
    for (const int k : v)
        square = std::max(square, paths.row(k).squaredNorm());
    for (int i = 0; i < split; ++i)
        for (int j = split; j < 4; ++j)
            square = std::max(square, (paths.row(v[i]) - paths.row(v[j])).squaredNorm());
    return std::sqrt(square);
}

// How much nearer two primitives can have come when their vertices have moved that far.
double travel_bound(const Eigen::VectorXd& moved, PairKind kind, const std::array<int, 4>& v)
{
    const double last = std::max(moved[v[2]], moved[v[3]]);
    return kind == PairKind::vertex_face ? moved[v[0]] + std::max(moved[v[1]], last)
                                         : std::max(moved[v[0]], moved[v[1]]) + last;
}

double sum_of(const Margins& margins, ContactReason reason)
{
    return margins.cloth + (reason == ContactReason::self ? margins.cloth : margins.obstacle);
}

// Vertices of the first primitive.
int first_size(PairKind kind) { return kind == PairKind::vertex_face ? 1 : 2; }

}  // namespace

ContactDetector::Surface ContactDetector::make_surface(const ContactSurface& surface, int offset)
{
    Surface result;
    result.triangles = (surface.triangles.array() + offset).matrix();
    result.edges = (surface.edges.array() + offset).matrix();
    result.vertices = used_vertices(result.triangles);
    return result;
}

ContactDetector::ContactDetector(const ContactSurface& cloth, const ContactSurface& obstacle, int body_vertices,
                                 const Margins& spare) :
    cloth_vertices_(cloth.vertices),
    first_layer_vertex_(cloth.vertices + body_vertices), cloth_(make_surface(cloth, 0)),
    obstacle_(make_surface(obstacle, cloth.vertices)), spare_(spare)
{
}

// The vertices of one primitive belong to one mesh, so its first or last one tells which.
ContactReason ContactDetector::reason_of(const std::array<int, 4>& vertices) const
{
    const int vertex = std::max(vertices.front(), vertices.back());
    if (vertex < cloth_vertices_)
        return ContactReason::self;
    return vertex < first_layer_vertex_ ? ContactReason::body : ContactReason::layer;
}

// A segment with a margin is convex: it holds a smaller one when it holds both of its ends. The margins of a move are
// smaller than those of the contacts at its end, so all are renewed by the largest ones: the pairs serve there, too.
std::vector<char> ContactDetector::renew_region(const Positions& x, const Positions& displacements,
                                                const Margins& margins)
{
    const Eigen::Index n = x.rows();
    const bool is_first = region_.start.rows() != n;
    asked_ = { std::max(asked_.cloth, margins.cloth), std::max(asked_.obstacle, margins.obstacle) };
    if (is_first) {
        x_ = region_.start = region_.path = Positions::Zero(n, 3);
        region_.margins.setConstant(n, -1);  // holds nothing
    }
    std::vector<char> renewed(n);
    for (Eigen::Index v = 0; v < n; ++v) {
        const auto of_vertex = [&](const Margins& m) { return v < cloth_vertices_ ? m.cloth : m.obstacle; };
        const Vec3 from = x.row(v), to = from + Vec3(displacements.row(v)), begin = region_.start.row(v),
                   end = begin + Vec3(region_.path.row(v));
        const double slack = region_.margins[v] - of_vertex(margins);
        if (slack >= 0 && distance_to_segment(from, begin, end) <= slack
            && distance_to_segment(to, begin, end) <= slack)
            continue;
        renewed[v] = true;
        const double spare = of_vertex(spare_), last_moved = (from - x_.row(v).transpose()).norm(),
                     moves = (to - from).norm();
        region_.start.row(v) = from;
        region_.path.row(v) = to - from;
        region_.margins[v] = of_vertex(asked_)
            + (is_first || std::max(last_moved, moves) < k_spare_used_up * spare ? 1 : k_spare_of_fast) * spare;
    }
    x_ = x;
    is_path_empty_ = region_.path.isZero(0);
    return renewed;
}

// Encloses the regions of these vertices.
template <class Vertices>
Box ContactDetector::box_of(const Vertices& vertices) const
{
    Box box;
    double margin = 0;
    for (const int v : vertices) {
        const Vec3 from = region_.start.row(v);
        box.extend(from);
        box.extend(from + Vec3(region_.path.row(v)));
        margin = std::max(margin, region_.margins[v]);
    }
    return { Vec3(box.min().array() - margin), Vec3(box.max().array() + margin) };
}

template <class VerticesOf>
void ContactDetector::renew_tree(BoxTree& tree, std::size_t count, const std::vector<char>& renewed,
                                 const VerticesOf& vertices_of) const
{
    tree.renew_or_build(
        count, [&](std::size_t i) { return has_marked(vertices_of(i), renewed); },
        [&](std::size_t i) { return box_of(vertices_of(i)); });
}

void ContactDetector::renew_trees(const std::vector<char>& renewed)
{
    parallel_for(6, [&](int i) {
        Surface& s = i % 2 == 0 ? cloth_ : obstacle_;
        if (i < 2)
            renew_tree(s.edge_tree, s.edges.rows(), renewed, [&](Eigen::Index e) { return s.edges.row(e); });
        else if (i < 4)
            renew_tree(s.triangle_tree, s.triangles.rows(), renewed,
                       [&](Eigen::Index t) { return s.triangles.row(t); });
        else
            renew_tree(s.vertex_tree, s.vertices.size(), renewed,
                       [&](std::size_t v) { return std::array<int, 1> { s.vertices[v] }; });
    });
}

void ContactDetector::search(const std::vector<char>& renewed)
{
    renew_trees(renewed);
    std::vector<Found> parts(BoxTree::k_parts);
    find_vertex_faces(cloth_, obstacle_, parts);
    find_vertex_faces(obstacle_, cloth_, parts);
    find_edge_edges(cloth_, obstacle_, parts);
    find_vertex_faces(cloth_, cloth_, parts);
    find_edge_edges(cloth_, cloth_, parts);

    const auto is_renewed = [&](const Candidate& c) { return has_marked(c.vertices, renewed); };
    candidates_.erase(std::remove_if(candidates_.begin(), candidates_.end(), is_renewed), candidates_.end());
    for (const Found& found : parts) {
        candidates_.insert(candidates_.end(), found.apart.begin(), found.apart.end());
        for (const Candidate& c : found.touching)
            if (c.reason == ContactReason::self)
                ignored(c.kind).insert(c.key);
    }
}

void ContactDetector::find_vertex_faces(const Surface& a, const Surface& b, std::vector<Found>& parts)
{
    BoxTree::overlaps(a.vertex_tree, b.triangle_tree, [&](int part, int i, int t) {
        const int v = a.vertices[i];
        const std::array<int, 4> vertices { v, b.triangles(t, 0), b.triangles(t, 1), b.triangles(t, 2) };
        add_candidate({ PairKind::vertex_face, reason_of(vertices), vertices, make_key(v, t), 0 }, parts[part]);
    });
}

void ContactDetector::find_edge_edges(const Surface& a, const Surface& b, std::vector<Found>& parts)
{
    BoxTree::overlaps(a.edge_tree, b.edge_tree, [&](int part, int i, int j) {
        if (&a == &b && j < i)
            std::swap(i, j);
        const std::array<int, 4> vertices { a.edges(i, 0), a.edges(i, 1), b.edges(j, 0), b.edges(j, 1) };
        add_candidate({ PairKind::edge_edge, reason_of(vertices), vertices, make_key(i, j), 0 }, parts[part]);
    });
}

void ContactDetector::add_candidate(Candidate c, Found& found)
{
    const int split = first_size(c.kind);
    if (c.reason == ContactReason::self && share_a_vertex(c.vertices, split))
        return;
    const Corners corners = corners_of(region_.start, c.vertices);
    const double near = (is_path_empty_ ? 0 : approach_bound(region_.path, c.vertices, split))
        + largest(region_.margins, c.vertices, 0, split) + largest(region_.margins, c.vertices, split, 4);
    if (are_surely_apart(c.kind, corners, near))
        return;
    c.distance = closest_points(c.kind, corners).distance;
    if (c.distance > near || (c.reason == ContactReason::self && ignored(c.kind).count(c.key)))
        return;
    const double touching = c.reason == ContactReason::self ? k_touching : 0;
    const bool touch = c.distance <= touching  // the starts of its vertices are of different searches
        && closest_points(c.kind, corners_of(x_, c.vertices)).distance <= touching;
    (touch ? found.touching : found.apart).push_back(c);
}

void ContactDetector::detect(const Positions& x, const Positions& displacements, const Margins& margins)
{
    if (const std::vector<char> renewed = renew_region(x, displacements, margins);
        std::find(renewed.begin(), renewed.end(), true) != renewed.end())
        search(renewed);
    const bool stands_still = displacements.isZero(0);
    const Eigen::VectorXd moved = (x - region_.start).rowwise().norm(), moves = displacements.rowwise().norm();
    pairs_ = parallel_collect<ContactPair>(candidates_.size(), [&](std::size_t i) -> std::optional<ContactPair> {
        const Candidate& c = candidates_[i];
        const double least = c.distance - travel_bound(moved, c.kind, c.vertices), margin = sum_of(margins, c.reason);
        if (least > travel_bound(moves, c.kind, c.vertices) + margin)  // most pairs; never less than the bound below
            return {};
        const double near = (stands_still ? 0 : approach_bound(displacements, c.vertices, first_size(c.kind))) + margin;
        if (least > near)
            return {};
        const Corners corners = corners_of(x, c.vertices);
        if (are_surely_apart(c.kind, corners, near))
            return {};
        const ClosestPoints at = closest_points(c.kind, corners);
        if (at.distance > near)
            return {};
        return ContactPair { c.kind, c.reason, c.vertices, at };
    });
}

}  // namespace garmentfit
