// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact.h"

#include <algorithm>
#include <atomic>

#include "fit/mesh.h"
#include "joined_vertices.h"
#include "parallel.h"

namespace fit {
namespace {

std::uint64_t key(int i, int j) { return (std::uint64_t(std::uint32_t(i)) << 32) | std::uint32_t(j); }

Corners corners(const Positions& x, const std::array<int, 4>& v)
{
    return { Vec3(x.row(v[0])), Vec3(x.row(v[1])), Vec3(x.row(v[2])), Vec3(x.row(v[3])) };
}

template <class Row>
Box box_of(const Row& vertices, const Positions& x, const std::vector<double>& reach)
{
    Box box;
    for (int k = 0; k < int(vertices.size()); ++k) {
        const Vec3 p = x.row(vertices[k]), r = Vec3::Constant(reach[vertices[k]]);
        box.extend(Vec3(p - r));
        box.extend(Vec3(p + r));
    }
    return box;
}

bool share_a_vertex(const std::array<int, 4>& v, int split)
{
    for (int i = 0; i < split; ++i)
        for (int j = split; j < 4; ++j)
            if (v[i] == v[j])
                return true;
    return false;
}

double reach_of(const std::array<int, 4>& v, int begin, int end, const std::vector<double>& reach)
{
    double largest = 0;
    for (int k = begin; k < end; ++k)
        largest = std::max(largest, reach[v[k]]);
    return largest;
}

void lower(std::atomic<double>& value, double to)
{
    double now = value.load(std::memory_order_relaxed);
    while (to < now && !value.compare_exchange_weak(now, to, std::memory_order_relaxed)) { }
}

/// The mean of the values of each set, at all of its vertices.
Positions means(JoinedVertices& sets, const Positions& values)
{
    Positions sum = Positions::Zero(values.rows(), 3);
    std::vector<int> size(values.rows(), 0);
    for (int v = 0; v < int(values.rows()); ++v) {
        sum.row(sets.root(v)) += values.row(v);
        ++size[sets.root(v)];
    }
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

Contact::Contact(const Triangles& cloth, int cloth_vertices, const Triangles& obstacle) :
    cloth_(surface(cloth, 0)), obstacle_(surface(obstacle, cloth_vertices))
{
}

void Contact::renew(Surface& s, const Positions& x, const std::vector<double>& reach) const
{
    std::vector<Box> vertices(s.vertices.size()), edges(s.edges.rows()), triangles(s.triangles.rows());
    for (std::size_t v = 0; v < vertices.size(); ++v)
        vertices[v] = box_of(std::array<int, 1> { s.vertices[v] }, x, reach);
    for (std::size_t e = 0; e < edges.size(); ++e)
        edges[e] = box_of(s.edges.row(e), x, reach);
    for (std::size_t t = 0; t < triangles.size(); ++t)
        triangles[t] = box_of(s.triangles.row(t), x, reach);
    const auto put = [](BoxTree& tree, const std::vector<Box>& boxes) {
        if (tree.empty())
            tree = BoxTree(boxes);
        else
            tree.refit(boxes);
    };
    put(s.vertex_tree, vertices);
    put(s.edge_tree, edges);
    put(s.triangle_tree, triangles);
}

void Contact::detect(const Positions& x, const std::vector<double>& reach)
{
    renew(cloth_, x, reach);
    renew(obstacle_, x, reach);

    std::vector<std::vector<ContactPair>> found(BoxTree::k_parts);
    std::vector<std::vector<std::uint64_t>> touching_faces(BoxTree::k_parts), touching_edges(BoxTree::k_parts);
    const auto keep = [&](int part, PairKind kind, bool self, const std::array<int, 4>& v, std::uint64_t pair_key) {
        const int split = kind == PairKind::vertex_face ? 1 : 2;
        if (self && share_a_vertex(v, split))
            return;
        const auto& passing = kind == PairKind::vertex_face ? passing_vertex_face_ : passing_edge_edge_;
        if (self && passing.count(pair_key))
            return;
        const Closest at = closest(kind, corners(x, v));
        if (at.distance > reach_of(v, 0, split, reach) + reach_of(v, split, 4, reach))
            return;
        if (at.distance > 0)
            found[part].push_back({ kind, self, v, at });
        else if (self)
            (kind == PairKind::vertex_face ? touching_faces : touching_edges)[part].push_back(pair_key);
    };
    const auto vertex_faces = [&](const Surface& a, const Surface& b, bool self) {
        BoxTree::overlaps(a.vertex_tree, b.triangle_tree, [&](int part, int i, int t) {
            const int v = a.vertices[i];
            keep(part, PairKind::vertex_face, self, { v, b.triangles(t, 0), b.triangles(t, 1), b.triangles(t, 2) },
                 key(v, t));
        });
    };
    const auto edge_edges = [&](const Surface& a, const Surface& b, bool self) {
        BoxTree::overlaps(a.edge_tree, b.edge_tree, [&](int part, int i, int j) {
            if (self && j < i)
                std::swap(i, j);
            keep(part, PairKind::edge_edge, self, { a.edges(i, 0), a.edges(i, 1), b.edges(j, 0), b.edges(j, 1) },
                 key(i, j));
        });
    };
    vertex_faces(cloth_, obstacle_, false);
    vertex_faces(obstacle_, cloth_, false);
    edge_edges(cloth_, obstacle_, false);
    vertex_faces(cloth_, cloth_, true);
    edge_edges(cloth_, cloth_, true);

    pairs_.clear();
    for (int part = 0; part < BoxTree::k_parts; ++part) {
        pairs_.insert(pairs_.end(), found[part].begin(), found[part].end());
        passing_vertex_face_.insert(touching_faces[part].begin(), touching_faces[part].end());
        passing_edge_edge_.insert(touching_edges[part].begin(), touching_edges[part].end());
    }
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
    JoinedVertices zones(int(x.rows()));
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
        common = means(zones, displacements);
    }
    return common;
}

}  // namespace fit
