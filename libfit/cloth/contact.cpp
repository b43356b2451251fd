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

// Encloses the paths of the vertices, and `margin` beside them.
template <class Row>
Box swept_box(const Row& vertices, const Positions& start, const Positions& path, double margin)
{
    Box box;
    for (int k = 0; k < int(vertices.size()); ++k) {
        const Vec3 from = start.row(vertices[k]), to = from + Vec3(path.row(vertices[k]));
        box.extend(from);
        box.extend(to);
    }
    return { Vec3(box.min().array() - margin), Vec3(box.max().array() + margin) };
}

template <class VerticesOf>
void refit_tree(BoxTree& tree, Eigen::Index count, const Positions& start, const Positions& path, double margin,
                const VerticesOf& vertices_of)
{
    std::vector<Box> boxes(count);
    for (Eigen::Index i = 0; i < count; ++i)
        boxes[i] = swept_box(vertices_of(i), start, path, margin);
    if (tree.empty())
        tree = BoxTree(boxes);
    else
        tree.refit(boxes);
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

// A segment with a margin is convex: it holds a smaller one when it holds both of its ends.
double ContactDetector::spare_lacking(const SweptRegion& region) const
{
    if (region_.start.rows() != region.start.rows())
        return INFINITY;
    const Margins slack { region_.margins.cloth - region.margins.cloth,
                          region_.margins.obstacle - region.margins.obstacle };
    double most = 0;
    for (Eigen::Index v = 0; v < region.start.rows(); ++v) {
        const auto of_vertex
            = [&](const Margins& margins) { return v < cloth_vertices_ ? margins.cloth : margins.obstacle; };
        const Vec3 from = region.start.row(v), to = from + Vec3(region.path.row(v)), begin = region_.start.row(v),
                   end = begin + Vec3(region_.path.row(v));
        const double away = std::max(distance_to_segment(from, begin, end), distance_to_segment(to, begin, end));
        if (const double beyond = away - of_vertex(slack); beyond > 0)
            most = std::max(most, beyond / of_vertex(spare_));
    }
    return most;
}

// Whether the trees of the obstacle, which stands still most of the time, serve for that region as they are.
bool ContactDetector::has_same_obstacle(const SweptRegion& region) const
{
    const auto obstacle = [&](const Positions& all) { return all.bottomRows(all.rows() - cloth_vertices_); };
    return region_.start.rows() == region.start.rows() && region_.margins.obstacle == region.margins.obstacle
        && obstacle(region_.start) == obstacle(region.start) && obstacle(region_.path) == obstacle(region.path);
}

void ContactDetector::refit_trees()
{
    parallel_for(6, [&](int i) {
        if (i % 2 == 1 && obstacle_is_fitted_)
            return;
        Surface& s = i % 2 == 0 ? cloth_ : obstacle_;
        const double margin = i % 2 == 0 ? region_.margins.cloth : region_.margins.obstacle;
        const auto refit = [&](BoxTree& tree, Eigen::Index count, const auto& vertices_of) {
            refit_tree(tree, count, region_.start, region_.path, margin, vertices_of);
        };
        if (i < 2)
            refit(s.edge_tree, s.edges.rows(), [&](Eigen::Index e) { return s.edges.row(e); });
        else if (i < 4)
            refit(s.triangle_tree, s.triangles.rows(), [&](Eigen::Index t) { return s.triangles.row(t); });
        else
            refit(s.vertex_tree, Eigen::Index(s.vertices.size()),
                  [&](Eigen::Index v) { return std::array<int, 1> { s.vertices[v] }; });
    });
}

// A search that served more than once was worth its spare margins.
void ContactDetector::choose_spare(double lacking)
{
    const bool served_again = has_spare_ && detections_ > 1;
    has_spare_ = served_again || (has_spare_ + lacking) / detections_ < k_spare_used_up;
    detections_ = 0;
}

void ContactDetector::search(SweptRegion region)
{
    if (has_spare_) {
        region.margins.cloth += spare_.cloth;
        region.margins.obstacle += spare_.obstacle;
    }
    obstacle_is_fitted_ = has_same_obstacle(region);
    is_path_empty_ = region.path.isZero(0);
    region_ = std::move(region);
    refit_trees();
    std::vector<Found> parts(BoxTree::k_parts);
    find_vertex_faces(cloth_, obstacle_, parts);
    find_vertex_faces(obstacle_, cloth_, parts);
    find_edge_edges(cloth_, obstacle_, parts);
    find_vertex_faces(cloth_, cloth_, parts);
    find_edge_edges(cloth_, cloth_, parts);

    candidates_.clear();
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
    const double near
        = (is_path_empty_ ? 0 : approach_bound(region_.path, c.vertices, split)) + sum_of(region_.margins, c.reason);
    if (are_surely_apart(c.kind, corners, near))
        return;
    c.distance = closest_points(c.kind, corners).distance;
    if (c.distance <= near && !(c.reason == ContactReason::self && ignored(c.kind).count(c.key)))
        (c.distance > 0 ? found.apart : found.touching).push_back(c);
}

void ContactDetector::detect(const Positions& x, const Positions& displacements, const Margins& margins)
{
    ++detections_;
    SweptRegion asked { x, displacements, margins };
    if (const double lacking = spare_lacking(asked); lacking > 0) {
        choose_spare(lacking);
        search(std::move(asked));
    }
    const bool stands_still = displacements.isZero(0);
    const Eigen::VectorXd moved = (x - region_.start).rowwise().norm();
    pairs_ = parallel_collect<ContactPair>(candidates_.size(), [&](std::size_t i) -> std::optional<ContactPair> {
        const Candidate& c = candidates_[i];
        const double near = (stands_still ? 0 : approach_bound(displacements, c.vertices, first_size(c.kind)))
            + sum_of(margins, c.reason);
        if (c.distance - travel_bound(moved, c.kind, c.vertices) > near)
            return {};
        const ClosestPoints at = closest_points(c.kind, corners_of(x, c.vertices));
        if (at.distance > near)
            return {};
        return ContactPair { c.kind, c.reason, c.vertices, at };
    });
}

}  // namespace garmentfit
