// SPDX-License-Identifier: GPL-3.0-or-later

// The overhead of VTK: the walking woman in a coat of 15 thousand vertices, dressed by the filters alone, by
// vtkDressBody, and written again by vtkDressBody without computing.

#include <benchmark/benchmark.h>

#include "garmentfit/filters/filters.h"
#include "garmentfit/io.h"
#include "polydata_of.h"
#include "resampled.h"

#include "vtkDressBody.h"
#include "vtkNew.h"

namespace {

using namespace garmentfit;

constexpr std::size_t k_vertices = 15000;

TriangleMesh read(const char* path)
{
    const MeshFile file = MeshFile::read(path);
    return { file.positions(), file.triangles() };
}

const TriangleMesh& woman()
{
    static const TriangleMesh mesh = read(GARMENTFIT_SAMPLES "/walking_woman.ply");
    return mesh;
}

const TriangleMesh& coat()
{
    static const TriangleMesh mesh = resampled(read(GARMENTFIT_SAMPLES "/coat.ply"), k_vertices);
    return mesh;
}

void by_the_filters(benchmark::State& state)
{
    Parameters parameters;
    parameters.fit.type = GarmentType::coat;
    for (auto _ : state) {
        Scene scene;
        scene.body = make_body(woman().positions, woman().triangles);
        scene.garments.push_back({ make_garment(coat().positions, coat().triangles), GarmentType::automatic });
        filter_of("dress").run(scene, parameters);
        benchmark::DoNotOptimize(scene);
    }
    state.counters["vertices"] = double(coat().positions.rows());
}

struct Pipeline {
    vtkSmartPointer<vtkPolyData> body = polydata_of(woman()), garment = polydata_of(coat());
    vtkNew<vtkDressBody> dress;

    Pipeline()
    {
        dress->SetInputData(0, body);
        dress->SetInputData(1, garment);
        dress->SetTypeByName("coat");
    }
};

void by_vtk(benchmark::State& state)
{
    for (auto _ : state) {
        const Pipeline pipeline;
        pipeline.dress->Update();
    }
    state.counters["vertices"] = double(coat().positions.rows());
}

/// vtkDressBody without the filters behind it.
void write_outputs_again(benchmark::State& state)
{
    const Pipeline pipeline;
    pipeline.dress->Update();
    for (auto _ : state) {
        pipeline.dress->Modified();
        pipeline.dress->Update();
    }
}

BENCHMARK(by_the_filters)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
BENCHMARK(by_vtk)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
BENCHMARK(write_outputs_again)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();

}  // namespace

BENCHMARK_MAIN();
