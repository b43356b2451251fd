// SPDX-License-Identifier: GPL-3.0-or-later

// Milliseconds of the parts of a move of the search for rest, by the number of vertices: the sample coat, refined.

#include <limits>

#include <benchmark/benchmark.h>

#include "cloth_energy.h"
#include "garmentfit/io.h"
#include "resampled.h"
#include "tangent_factor.h"

namespace {

using namespace garmentfit;

struct Coat {
    explicit Coat(int level)
    {
        const MeshFile file = MeshFile::read(GARMENTFIT_SAMPLES "/coat.ply");
        TriangleMesh mesh { file.positions(), file.triangles() };
        for (int i = 0; i < level; ++i)
            mesh = Refinement(mesh).round(std::numeric_limits<std::size_t>::max());
        x = mesh.positions;
        const MeshTopology topology(mesh.triangles, int(x.rows()));
        energy.emplace(GarmentMesh { x, mesh.triangles }, topology, std::vector<std::pair<int, int>> {},
                       ClothOptions());
        energy->set_time_step(0.5);
        factor.emplace(*energy);
        factor->factorise(x, {});
        forces = Positions::Zero(x.rows(), 3);
        for (Eigen::Index v = 0; v < x.rows(); ++v)
            forces(v, 1) = -energy->masses()[v];
    }

    Positions x, forces;
    std::optional<ClothEnergy> energy;
    std::optional<TangentFactor> factor;
};

template <class Part>
void time_part(benchmark::State& state, const Part& part)
{
    Coat coat(int(state.range(0)));
    for (auto _ : state)
        part(coat);
    state.counters["vertices"] = double(coat.x.rows());
}

void factorise(benchmark::State& state)
{
    time_part(state, [](Coat& coat) { coat.factor->factorise(coat.x, {}); });
}
void solve(benchmark::State& state)
{
    time_part(state, [](Coat& coat) { benchmark::DoNotOptimize(coat.factor->solve(coat.forces)); });
}
void elastic_forces(benchmark::State& state)
{
    time_part(state, [](Coat& coat) { benchmark::DoNotOptimize(coat.energy->elastic_forces(coat.x)); });
}
BENCHMARK(factorise)->DenseRange(0, 1)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
BENCHMARK(solve)->DenseRange(0, 1)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
BENCHMARK(elastic_forces)->DenseRange(0, 1)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

}  // namespace

BENCHMARK_MAIN();
