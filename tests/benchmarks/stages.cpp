// SPDX-License-Identifier: GPL-3.0-or-later

// Seconds of rigging, fitting, draping and recovering by the number of vertices: the samples, refined.

#include <limits>

#include <benchmark/benchmark.h>

#include "garmentfit/drape_garment.h"
#include "garmentfit/filters/filters.h"
#include "garmentfit/fit_skeleton.h"
#include "garmentfit/io.h"
#include "garmentfit/recover_pose.h"
#include "garmentfit/rig_body.h"
#include "resampled.h"

namespace {

using namespace garmentfit;

TriangleMesh read(const char* path)
{
    const MeshFile file = MeshFile::read(path);
    return { file.positions(), file.triangles() };
}

/// Each triangle cut into four, so many times.
TriangleMesh at_level(const char* path, int level)
{
    TriangleMesh mesh = read(path);
    for (int i = 0; i < level; ++i)
        mesh = Refinement(mesh).round(std::numeric_limits<std::size_t>::max());
    return mesh;
}

BodyMesh body(int level = 0)
{
    const TriangleMesh mesh = at_level(GARMENTFIT_SAMPLES "/walking_woman.ply", level);
    return make_body(mesh.positions, mesh.triangles);
}

FitOptions as(GarmentType type)
{
    FitOptions options;
    options.type = type;
    return options;
}

void count_vertices(benchmark::State& state, const Positions& positions)
{
    state.counters["vertices"] = double(positions.rows());
}

/// How a run's time is shared between detection and solver.
void count_seconds(benchmark::State& state, const ClothSeconds& seconds)
{
    state.counters["detection"] = { seconds.detection, benchmark::Counter::kAvgIterations };
    state.counters["solver"] = { seconds.solver, benchmark::Counter::kAvgIterations };
}

/// Closing and rigging, and the growth of the time with the vertices.
void rig(benchmark::State& state)
{
    const TriangleMesh man = refined(read(GARMENTFIT_BODIES "/man_a_pose.ply"), std::size_t(state.range(0)));
    for (auto _ : state)
        benchmark::DoNotOptimize(rig_body(make_body(man.positions, man.triangles)));
    count_vertices(state, man.positions);
    state.SetComplexityN(man.positions.rows());
}
BENCHMARK(rig)
    ->Arg(3000)
    ->Arg(7000)
    ->Arg(13380)
    ->Arg(50000)
    ->Arg(100000)
    ->Arg(400000)
    ->Unit(benchmark::kSecond)
    ->Complexity();

/// Each run begins anew: no result of a run before is kept.
void fit_to(benchmark::State& state, const char* path, GarmentType type)
{
    const Rig rigged = rig_body(body());
    const TriangleMesh mesh = at_level(path, int(state.range(0)));
    const GarmentMesh garment = make_garment(mesh.positions, mesh.triangles);
    for (auto _ : state)
        benchmark::DoNotOptimize(fit_skeleton(rigged, garment, as(type)));
    count_vertices(state, garment.positions);
}

void fit_skirt(benchmark::State& state) { fit_to(state, GARMENTFIT_SAMPLES "/skirt.ply", GarmentType::skirt); }
void fit_coat(benchmark::State& state) { fit_to(state, GARMENTFIT_SAMPLES "/coat.ply", GarmentType::coat); }
BENCHMARK(fit_skirt)->DenseRange(0, 3)->Unit(benchmark::kSecond);
BENCHMARK(fit_coat)->DenseRange(0, 2)->Unit(benchmark::kSecond);

/// A coat of so many vertices, and a body rigged and posed for it.
struct Fitted {
    BodyMesh woman = body();
    Rig rigged = rig_body(woman);
    GarmentMesh garment;
    Pose pose;

    explicit Fitted(benchmark::State& state)
    {
        const TriangleMesh mesh = resampled(read(GARMENTFIT_SAMPLES "/coat.ply"), std::size_t(state.range(0)));
        garment = make_garment(mesh.positions, mesh.triangles);
        pose = fit_skeleton(rigged, garment, as(GarmentType::coat)).pose;
        count_vertices(state, garment.positions);
        state.SetComplexityN(garment.positions.rows());
    }
};

void drape(benchmark::State& state)
{
    const Fitted coat(state);
    ClothSeconds seconds;
    for (auto _ : state)
        seconds += drape_garment(coat.rigged, coat.woman, { coat.pose }, coat.garment).seconds;
    count_seconds(state, seconds);
}

void recover(benchmark::State& state)
{
    const Fitted coat(state);
    const DrapeResult draped = drape_garment(coat.rigged, coat.woman, { coat.pose }, coat.garment);
    ClothSeconds seconds;
    for (auto _ : state)
        seconds += recover_pose(coat.rigged, coat.woman, draped, Pose()).seconds;
    count_seconds(state, seconds);
}

/// Dressing as hosts run it, each time from the same scene.
void run_filter(benchmark::State& state, const Filter& filter, const Scene& start, Quality quality)
{
    Parameters parameters;
    parameters.recover.quality = quality;
    parameters.time_limit = 0;
    Scene scene;
    for (auto _ : state) {
        scene = start;
        filter.run(scene, parameters);
    }
    state.counters["drape"] = scene.seconds[int(Stage::drape)];
    state.counters["recover"] = scene.seconds[int(Stage::recover)];
    state.counters["certified"] = scene.recovered && scene.recovered->certified;
}

/// Fitting, draping and recovering: a rough copy may lead the coat.
void dress(benchmark::State& state, Quality quality)
{
    const Fitted coat(state);
    Scene scene;
    scene.body = coat.woman;
    scene.rig = coat.rigged;
    scene.garments = { { coat.garment, GarmentType::coat } };
    run_filter(state, filter_of("dress").on_known_rig(), scene, quality);
}

void dress_to_rest(benchmark::State& state) { dress(state, Quality::standard); }
void dress_in_draft(benchmark::State& state) { dress(state, Quality::draft); }

void cloth_sizes(benchmark::internal::Benchmark* run)
{
    for (const int vertices : { 2000, 4000, 8000, 15000, 30000, 60000 })
        run->Arg(vertices);
    run->Unit(benchmark::kSecond)->Complexity();
}

/// The skirt on a body of so many vertices: from some tens of thousands on it is dressed on fewer.
void dress_fine_body(benchmark::State& state)
{
    const TriangleMesh woman = at_level(GARMENTFIT_SAMPLES "/walking_woman.ply", int(state.range(0)));
    const TriangleMesh skirt = read(GARMENTFIT_SAMPLES "/skirt.ply");
    Scene scene;
    scene.body = make_body(woman.positions, woman.triangles);
    scene.garments = { { make_garment(skirt.positions, skirt.triangles), GarmentType::skirt } };
    run_filter(state, filter_of("dress"), scene, Quality::draft);
    count_vertices(state, woman.positions);
    state.SetComplexityN(woman.positions.rows());
}
BENCHMARK(dress_fine_body)->DenseRange(0, 3)->Unit(benchmark::kSecond)->Complexity();

BENCHMARK(drape)->Apply(cloth_sizes);
BENCHMARK(recover)->Apply(cloth_sizes);
BENCHMARK(dress_to_rest)->Apply(cloth_sizes);
BENCHMARK(dress_in_draft)->Apply(cloth_sizes);

}  // namespace

BENCHMARK_MAIN();
