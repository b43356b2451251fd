// SPDX-License-Identifier: GPL-3.0-or-later

// What the trees of libfit cost, side by side: docs/decisions/0016-trees.md has the figures that decided which ones
// stay.

#include <functional>
#include <numeric>
#include <random>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <benchmark/benchmark.h>

#include "box_tree.h"
#include "cloth_tree.h"
#include "crossing_tree.h"
#include "garmentfit/io.h"
#include "garmentfit/mesh.h"
#include "nearest.h"
#include "vertex_tree.h"
#include "winding_number.h"

namespace {

using namespace garmentfit;

const TriangleMesh& coat()
{
    static const MeshFile file = MeshFile::read(GARMENTFIT_SAMPLES "/coat.ply");
    static const TriangleMesh mesh { file.positions(), file.triangles() };
    return mesh;
}

/// Places all over the coat's box: most of them inside its tubes, as bones are.
std::vector<Vec3> places(int count)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> share(0, 1);
    const Vec3 low = coat().positions.colwise().minCoeff(), high = coat().positions.colwise().maxCoeff();
    std::vector<Vec3> result;
    for (int i = 0; i < count; ++i) {
        const double x = share(random), y = share(random), z = share(random);
        result.push_back(low + (high - low).cwiseProduct(Vec3(x, y, z)));
    }
    return result;
}

template <class Tree, class Mesh>
void build(benchmark::State& state, const Mesh& mesh)
{
    for (auto _ : state)
        benchmark::DoNotOptimize(Tree(mesh));
}

template <class Query>
void ask(benchmark::State& state, const Query& query)
{
    const std::vector<Vec3> at = places(4096);
    std::size_t i = 0;
    for (auto _ : state)
        benchmark::DoNotOptimize(query(at[++i % at.size()]));
}

/// Ends of a bone of 10 cm or so.
template <class Tree>
auto is_met(const Tree& tree)
{
    return [&](const Vec3& p) { return tree.is_met(p, p + Vec3(0.03, 0.1, 0.02)); };
}

std::vector<Box> edge_boxes()
{
    const auto edges = edges_of(coat().triangles);
    std::vector<Box> boxes;
    for (const auto& edge : edges.rowwise()) {
        const Vec3 a = coat().positions.row(edge[0]), b = coat().positions.row(edge[1]), margin = Vec3::Constant(0.002);
        boxes.emplace_back(a.cwiseMin(b) - margin, a.cwiseMax(b) + margin);
    }
    return boxes;
}

void pairs_of_box_tree(benchmark::State& state)
{
    const std::vector<Box> boxes = edge_boxes();
    BoxTree tree(boxes);
    std::vector<std::size_t> found(BoxTree::k_parts);
    for (auto _ : state) {
        tree.refit(boxes);
        BoxTree::overlaps(tree, tree, [&](int part, int, int) { ++found[part]; });
    }
    state.counters["pairs"] = double(std::accumulate(found.begin(), found.end(), 0.0) / double(state.iterations()));
}

/// The library's sort and sweep. It has no memory of the last step.
void pairs_of_cgal(benchmark::State& state)
{
    using CgalBox = CGAL::Box_intersection_d::Box_with_info_d<double, 3, int>;
    std::vector<CgalBox> boxes;
    const std::vector<Box> given = edge_boxes();
    for (int i = 0; i < int(given.size()); ++i)
        boxes.emplace_back(CGAL::Bbox_3(given[i].min().x(), given[i].min().y(), given[i].min().z(), given[i].max().x(),
                                        given[i].max().y(), given[i].max().z()),
                           i);
    std::size_t found = 0;
    for (auto _ : state)
        CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const CgalBox&, const CgalBox&) { ++found; });
    state.counters["pairs"] = double(found) / double(state.iterations());
}

void add(const char* name, const std::function<void(benchmark::State&)>& run)
{
    benchmark::RegisterBenchmark(name, run)->Unit(benchmark::kMicrosecond);
}

}  // namespace

int main(int argc, char** argv)
{
    benchmark::Initialize(&argc, argv);
    const Positions& vertices = coat().positions;
    add("nearest vertex: NearestPoint, build", [&](auto& s) { build<NearestPoint>(s, vertices); });
    add("nearest vertex: VertexTree, build", [&](auto& s) { build<VertexTree>(s, vertices); });
    add("nearest vertex: NearestPoint (FLANN)",
        [&](auto& s) { ask(s, [tree = NearestPoint(vertices)](const Vec3& p) { return tree.index(p); }); });
    add("nearest vertex: VertexTree",
        [&](auto& s) { ask(s, [tree = VertexTree(vertices)](const Vec3& p) { return tree.index(p, INFINITY); }); });
    add("nearest vertex: PointScan",
        [&](auto& s) { ask(s, [scan = PointScan(vertices)](const Vec3& p) { return scan.index(p); }); });

    add("segment meets cloth: TriangleTree, build", [&](auto& s) { build<TriangleTree>(s, coat()); });
    add("segment meets cloth: CrossingTree, build", [&](auto& s) { build<CrossingTree>(s, coat()); });
    const TriangleTree triangles(coat());
    const CrossingTree crossings(coat());
    add("segment meets cloth: TriangleTree (CGAL)", [&](auto& s) { ask(s, is_met(triangles)); });
    add("segment meets cloth: CrossingTree", [&](auto& s) { ask(s, is_met(crossings)); });

    const WindingNumber winding(coat());
    const ClothTree cloth(cloth_patches(coat(), 0.015));
    add("winding number: WindingNumber", [&](auto& s) { ask(s, winding); });
    add("winding number: ClothTree", [&](auto& s) { ask(s, [&](const Vec3& p) { return cloth.winding(p); }); });
    add("winding number: all triangles",
        [&](auto& s) { ask(s, [&](const Vec3& p) { return winding_number(coat(), p); }); });
    add("distance: TriangleTree (CGAL)",
        [&](auto& s) { ask(s, [&](const Vec3& p) { return triangles.distance(p); }); });
    add("distance: ClothTree", [&](auto& s) { ask(s, [&](const Vec3& p) { return cloth.distance(p); }); });

    add("close pairs of edges: BoxTree, refitted", pairs_of_box_tree);
    add("close pairs of edges: CGAL's boxes", pairs_of_cgal);
    benchmark::RunSpecifiedBenchmarks();
}
