// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>

#include "garmentfit/mesh.h"
#include "disjoint_sets.h"
#include "parallel.h"
#include "segment.h"

namespace garmentfit {
namespace {

std::uint64_t key(int i, int j) { return (std::uint64_t(std::uint32_t(i)) << 32) | std::uint32_t(j); }

Corners corners(const Positions& x, const std::array<int, 4>& v)
{
    return { Vec3(x.row(v[0])), Vec3(x.row(v[1])), Vec3(x.row(v[2])), Vec3(x.row(v[3])) };
}

// Encloses all that the vertices may do: go along their ways, and `margin` beside them.
template <class Row>
Box box_of(const Row& vertices, const Positions& start, const Positions& way, double margin)
{
    Box box;
    for (int k = 0; k < int(vertices.size()); ++k) {
        const Vec3 from = start.row(vertices[k]), to = from + Vec3(way.row(vertices[k]));
        box.extend(from);
        box.extend(to);
    }
    return { Vec3(box.min().array() - margin), Vec3(box.max().array() + margin) };
}

bool share_a_vertex(const std::array<int, 4>& v, int split)
{
    for (int i = 0; i < split; ++i)
        for (int j = split; j < 4; ++j)
            if (v[i] == v[j])
                return true;
    return false;
}

// How much nearer two primitives can come when each vertex goes any share of its way: whatever the shares, the change of
// their separation is a mean of single ways and of differences of two of them.
double approach(const Positions& ways, const std::array<int, 4>& v, int split)
{
    double square = 0;
    for (const int k : v)
        square = std::max(square, ways.row(k).squaredNorm());
    for (int i = 0; i < split; ++i)
        for (int j = split; j < 4; ++j)
            square = std::max(square, (ways.row(v[i]) - ways.row(v[j])).squaredNorm());
    return std::sqrt(square);
}

// How much nearer two primitives can have come when their vertices have moved that far.
double travel_bound(const Eigen::VectorXd& moved, PairKind kind, const std::array<int, 4>& v)
{
    const double last = std::max(moved[v[2]], moved[v[3]]);
    return kind == PairKind::vertex_face ? moved[v[0]] + std::max(moved[v[1]], last)
                                         : std::max(moved[v[0]], moved[v[1]]) + last;
}

double both(const Margins& margins, bool self) { return margins.cloth + (self ? margins.cloth : margins.obstacle); }

int first_size(PairKind kind) { return kind == PairKind::vertex_face ? 1 : 2; }

void lower(std::atomic<double>& value, double to)
{
    double now = value.load(std::memory_order_relaxed);
    while (to < now && !value.compare_exchange_weak(now, to, std::memory_order_relaxed)) { }
}

/// The mean of the values of each set, at all of its vertices; 0 where one of them, from `standing` on, stands still.
Positions means(DisjointSets& sets, const Positions& values, int standing)
{
    Positions sum = Positions::Zero(values.rows(), 3);
    std::vector<int> size(values.rows(), 0);
    for (int v = 0; v < int(values.rows()); ++v) {
        sum.row(sets.root(v)) += values.row(v);
        ++size[sets.root(v)];
    }
    for (int v = standing; v < int(values.rows()); ++v)
        sum.row(sets.root(v)).setZero();
    Positions result(values.rows(), 3);
    for (int v = 0; v < int(values.rows()); ++v)
        result.row(v) = sum.row(sets.root(v)) / size[sets.root(v)];
    return result;
}

}  // namespace

Contact::Surface Contact::surface(const Triangles& triangles, int offset)
{
    Surface s;
    s.triangles = (triangles.array() + offset).matrix();
    s.edges = edges_of(s.triangles);
    s.vertices.assign(s.triangles.data(), s.triangles.data() + s.triangles.size());
    std::sort(s.vertices.begin(), s.vertices.end());
    s.vertices.erase(std::unique(s.vertices.begin(), s.vertices.end()), s.vertices.end());
    return s;
}

Contact::Contact(const Triangles& cloth, int cloth_vertices, const Triangles& obstacle, const Margins& spare) :
    cloth_(surface(cloth, 0)), obstacle_(surface(obstacle, cloth_vertices)), cloth_vertices_(cloth_vertices),
    spare_(spare)
{
}

// A segment with a margin is convex: it holds a smaller one when it holds both of its ends.
bool Contact::searched(const SweptRegion& region) const
{
    if (searched_region_.start.rows() != region.start.rows())
        return false;
    for (Eigen::Index v = 0; v < region.start.rows(); ++v) {
        const Vec3 from = region.start.row(v), to = from + Vec3(region.way.row(v)), begin = searched_region_.start.row(v),
                   end = begin + Vec3(searched_region_.way.row(v));
        const double spare = v < cloth_vertices_ ? searched_region_.margins.cloth - region.margins.cloth
                                                 : searched_region_.margins.obstacle - region.margins.obstacle;
        if (distance_to_segment(from, begin, end) > spare || distance_to_segment(to, begin, end) > spare)
            return false;
    }
    return true;
}

void Contact::renew_trees()
{
    const auto renew = [&](BoxTree& tree, double margin, Eigen::Index count, const auto& vertices_of) {
        std::vector<Box> boxes(count);
        for (Eigen::Index i = 0; i < count; ++i)
            boxes[i] = box_of(vertices_of(i), searched_region_.start, searched_region_.way, margin);
        if (tree.empty())
            tree = BoxTree(boxes);
        else
            tree.refit(boxes);
    };
    parallel_for(6, [&](int i) {
        Surface& s = i % 2 == 0 ? cloth_ : obstacle_;
        const double margin = i % 2 == 0 ? searched_region_.margins.cloth : searched_region_.margins.obstacle;
        if (i < 2)
            renew(s.edge_tree, margin, s.edges.rows(), [&](Eigen::Index e) { return s.edges.row(e); });
        else if (i < 4)
            renew(s.triangle_tree, margin, s.triangles.rows(), [&](Eigen::Index t) { return s.triangles.row(t); });
        else
            renew(s.vertex_tree, margin, Eigen::Index(s.vertices.size()),
                  [&](Eigen::Index v) { return std::array<int, 1> { s.vertices[v] }; });
    });
}

void Contact::search()
{
    renew_trees();

    std::vector<std::vector<Candidate>> found(BoxTree::k_parts), touching(BoxTree::k_parts);
    const auto keep = [&](int part, Candidate c) {
        const int split = first_size(c.kind);
        if (c.self && (share_a_vertex(c.vertices, split) || passing(c.kind).count(c.key)))
            return;
        c.distance = closest(c.kind, corners(searched_region_.start, c.vertices)).distance;
        if (c.distance <= approach(searched_region_.way, c.vertices, split) + both(searched_region_.margins, c.self))
            (c.distance > 0 ? found : touching)[part].push_back(c);
    };
    const auto vertex_faces = [&](const Surface& a, const Surface& b, bool self) {
        BoxTree::overlaps(a.vertex_tree, b.triangle_tree, [&](int part, int i, int t) {
            const int v = a.vertices[i];
            keep(part,
                 { PairKind::vertex_face,
                   self,
                   { v, b.triangles(t, 0), b.triangles(t, 1), b.triangles(t, 2) },
                   key(v, t),
                   0 });
        });
    };
    const auto edge_edges = [&](const Surface& a, const Surface& b, bool self) {
        BoxTree::overlaps(a.edge_tree, b.edge_tree, [&](int part, int i, int j) {
            if (self && j < i)
                std::swap(i, j);
            keep(part,
                 { PairKind::edge_edge,
                   self,
                   { a.edges(i, 0), a.edges(i, 1), b.edges(j, 0), b.edges(j, 1) },
                   key(i, j),
                   0 });
        });
    };
    vertex_faces(cloth_, obstacle_, false);
    vertex_faces(obstacle_, cloth_, false);
    edge_edges(cloth_, obstacle_, false);
    vertex_faces(cloth_, cloth_, true);
    edge_edges(cloth_, cloth_, true);

    candidates_.clear();
    for (int part = 0; part < BoxTree::k_parts; ++part) {
        candidates_.insert(candidates_.end(), found[part].begin(), found[part].end());
        for (const Candidate& c : touching[part])
            if (c.self)
                passing(c.kind).insert(c.key);
    }
}

void Contact::detect(const Positions& x, const Positions& displacements, const Margins& margins)
{
    if (!searched({ x, displacements, margins })) {
        searched_region_ = { x, displacements, { margins.cloth + spare_.cloth, margins.obstacle + spare_.obstacle } };
        search();
    }
    const Eigen::VectorXd moved = (x - searched_region_.start).rowwise().norm();
    pairs_ = parallel_collect<ContactPair>(candidates_.size(), [&](std::size_t i) -> std::optional<ContactPair> {
        const Candidate& c = candidates_[i];
        const double near = approach(displacements, c.vertices, first_size(c.kind)) + both(margins, c.self);
        if (c.distance - travel_bound(moved, c.kind, c.vertices) > near)
            return {};
        const Closest at = closest(c.kind, corners(x, c.vertices));
        if (at.distance > near)
            return {};
        return ContactPair { c.kind, c.self, c.vertices, at };
    });
}

std::vector<double> Contact::free_shares(const Positions& x, const Positions& displacements, double gap) const
{
    constexpr int k_rounds = 30;  // then what still meets stands still, which always ends: the present state is free
    std::vector<double> shares(x.rows(), 1.0);
    std::vector<char> changed(x.rows());
    for (Eigen::Index v = 0; v < x.rows(); ++v)
        changed[v] = !displacements.row(v).isZero(0);
    std::vector<std::atomic<double>> next(x.rows());
    for (int round = 0;; ++round) {
        for (std::size_t v = 0; v < shares.size(); ++v)
            next[v].store(shares[v], std::memory_order_relaxed);
        const auto cut = [&](std::size_t p) {
            const auto& v = pairs_[p].vertices;
            if (!(changed[v[0]] || changed[v[1]] || changed[v[2]] || changed[v[3]]))
                return;
            Corners d = corners(displacements, v);
            for (int k = 0; k < 4; ++k)
                d[k] *= shares[v[k]];
            const double now = pairs_[p].at.distance;
            if (relative_travel(pairs_[p].kind, d) <= now - kept_distance(now, gap))
                return;
            const double share = free_share(pairs_[p].kind, corners(x, v), d, gap);
            if (share < 1)
                for (int k = 0; k < 4; ++k)
                    lower(next[v[k]], round < k_rounds ? shares[v[k]] * std::min(share, 0.9) : 0.0);
        };
        parallel_for(pairs_.size(), cut, std::size_t(1024));
        bool any = false;
        for (std::size_t v = 0; v < shares.size(); ++v) {
            const double share = next[v].load(std::memory_order_relaxed);
            changed[v] = share != shares[v];
            any |= changed[v];
            shares[v] = share;
        }
        if (!any)
            return shares;
    }
}

// What moves as one may lock further pairs, so zones grow until none is left that cannot go nearly all of its way.
Positions Contact::joined(const Positions& x, const Positions& displacements, double gap) const
{
    constexpr double k_nearly_all = 0.9;
    DisjointSets zones(int(x.rows()));
    const int standing
        = displacements.bottomRows(x.rows() - cloth_vertices_).isZero(0) ? int(cloth_vertices_) : int(x.rows());
    Positions common = displacements;
    std::vector<char> locked(pairs_.size());
    for (bool grown = true; grown;) {
        const auto test = [&](std::size_t p) {
            const auto& v = pairs_[p].vertices;
            locked[p] = free_share(pairs_[p].kind, corners(x, v), corners(common, v), gap) < k_nearly_all;
        };
        parallel_for(pairs_.size(), test, std::size_t(1024));
        grown = false;
        for (std::size_t p = 0; p < pairs_.size(); ++p)
            if (locked[p])
                for (int k = 1; k < 4; ++k)
                    grown |= zones.join(pairs_[p].vertices[0], pairs_[p].vertices[k]);
        common = means(zones, displacements, standing);
    }
    return common;
}

}  // namespace garmentfit
