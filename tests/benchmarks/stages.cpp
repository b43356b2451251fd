// SPDX-License-Identifier: GPL-3.0-or-later

// Seconds of rigging, fitting and draping by the number of vertices: the samples, each triangle cut into four once or twice.

#include <map>

#include <benchmark/benchmark.h>

#include "fit/drape_garment.h"
#include "fit/fit_skeleton.h"
#include "fit/io.h"
#include "fit/rig_body.h"

namespace {

using namespace fit;

TriangleMesh read(const char* path)
{
    const MeshFile file = MeshFile::read(path);
    return { file.positions(), file.triangles() };
}

TriangleMesh subdivided(const TriangleMesh& mesh)
{
    const auto edges = edges_of(mesh.triangles);
    const Eigen::Index n = mesh.positions.rows();
    TriangleMesh result { Positions(n + edges.rows(), 3), Triangles(4 * mesh.triangles.rows(), 3) };
    result.positions.topRows(n) = mesh.positions;
    std::map<std::pair<int, int>, int> middle;
    for (Eigen::Index e = 0; e < edges.rows(); ++e) {
        middle[{ edges(e, 0), edges(e, 1) }] = int(n + e);
        result.positions.row(n + e) = 0.5 * (mesh.positions.row(edges(e, 0)) + mesh.positions.row(edges(e, 1)));
    }
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
        const int a = mesh.triangles(f, 0), b = mesh.triangles(f, 1), c = mesh.triangles(f, 2);
        const int ab = middle[std::minmax(a, b)], bc = middle[std::minmax(b, c)], ca = middle[std::minmax(c, a)];
        result.triangles.middleRows(4 * f, 4) << a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca;
    }
    return result;
}

TriangleMesh at_level(const char* path, int level)
{
    TriangleMesh mesh = read(path);
    for (int i = 0; i < level; ++i)
        mesh = subdivided(mesh);
    return mesh;
}

BodyMesh body(int level = 0)
{
    const TriangleMesh mesh = at_level(FIT_SAMPLES "/walking_woman.ply", level);
    return make_body(mesh.positions, mesh.triangles);
}

GarmentMesh coat(int level)
{
    const TriangleMesh mesh = at_level(FIT_SAMPLES "/coat.ply", level);
    return make_garment(mesh.positions, mesh.triangles);
}

FitOptions as_coat()
{
    FitOptions options;
    options.type = GarmentType::coat;
    return options;
}

void count_vertices(benchmark::State& state, const Positions& positions)
{
    state.counters["vertices"] = double(positions.rows());
}

/// Closing and rigging: 3, 12, 48, 192 and 768 thousand vertices, and the growth of the time with them.
void rig(benchmark::State& state)
{
    const TriangleMesh man = at_level(FIT_BODIES "/man_a_pose.ply", int(state.range(0)));
    for (auto _ : state)
        benchmark::DoNotOptimize(rig_body(make_body(man.positions, man.triangles)));
    count_vertices(state, man.positions);
    state.SetComplexityN(man.positions.rows());
}
BENCHMARK(rig)->DenseRange(0, 4)->Unit(benchmark::kSecond)->Complexity();

void fit_to_garment(benchmark::State& state)
{
    const Rig rigged = rig_body(body());
    const GarmentMesh garment = coat(int(state.range(0)));
    for (auto _ : state)
        benchmark::DoNotOptimize(fit_skeleton(rigged, garment, as_coat()));
    count_vertices(state, garment.positions);
}
BENCHMARK(fit_to_garment)->DenseRange(0, 2)->Unit(benchmark::kSecond);

void drape(benchmark::State& state)
{
    const BodyMesh woman = body();
    const Rig rigged = rig_body(woman);
    const GarmentMesh garment = coat(int(state.range(0)));
    const Pose pose = fit_skeleton(rigged, garment, as_coat()).pose;
    for (auto _ : state)
        benchmark::DoNotOptimize(drape_garment(rigged, woman, pose, garment));
    count_vertices(state, garment.positions);
}
BENCHMARK(drape)->DenseRange(0, 1)->Unit(benchmark::kSecond);

}  // namespace

BENCHMARK_MAIN();
