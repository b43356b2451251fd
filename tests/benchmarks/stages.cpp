// SPDX-License-Identifier: GPL-3.0-or-later

// Seconds of rigging, fitting, draping and recovering by the number of vertices: the samples, refined.

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include "fit/drape_garment.h"
#include "fit/fit_skeleton.h"
#include "fit/io.h"
#include "fit/recover_pose.h"
#include "fit/rig_body.h"

namespace {

using namespace fit;

TriangleMesh read(const char* path)
{
    const MeshFile file = MeshFile::read(path);
    return { file.positions(), file.triangles() };
}

/// Cuts triangles at the middles of their longest edges until there are so many vertices; no edge twice in a round.
class Refinement {
public:
    explicit Refinement(const TriangleMesh& mesh) : points_(mesh.positions.rows())
    {
        for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v)
            points_[v] = mesh.positions.row(v);
        for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
            faces_.push_back({ mesh.triangles(f, 0), mesh.triangles(f, 1), mesh.triangles(f, 2) });
    }

    std::size_t vertices() const { return points_.size(); }

    /// @return the mesh with at most so many vertices: fewer, where each edge is already cut
    TriangleMesh round(std::size_t most)
    {
        cut_longest_edges(most - points_.size());
        std::vector<Face> faces;
        std::swap(faces, faces_);
        for (const Face& face : faces)
            split(face);
        TriangleMesh mesh { Positions(points_.size(), 3), Triangles(faces_.size(), 3) };
        for (std::size_t v = 0; v < points_.size(); ++v)
            mesh.positions.row(Eigen::Index(v)) = points_[v];
        for (std::size_t f = 0; f < faces_.size(); ++f)
            mesh.triangles.row(Eigen::Index(f)) << faces_[f][0], faces_[f][1], faces_[f][2];
        return mesh;
    }

private:
    using Face = std::array<int, 3>;

    void cut_longest_edges(std::size_t count)
    {
        std::set<std::pair<int, int>> edges;
        for (const Face& f : faces_)
            for (int k = 0; k < 3; ++k)
                edges.insert(std::minmax({ f[k], f[(k + 1) % 3] }));
        std::vector<std::pair<int, int>> longest(edges.begin(), edges.end());
        const auto length = [&](const auto& e) { return (points_[e.first] - points_[e.second]).norm(); };
        std::stable_sort(longest.begin(), longest.end(),
                         [&](const auto& a, const auto& b) { return length(a) > length(b); });
        longest.resize(std::min(count, longest.size()));
        middles_.clear();
        for (const auto& e : longest) {
            middles_[e] = int(points_.size());
            points_.push_back(0.5 * (points_[e.first] + points_[e.second]));
        }
    }

    void split(const Face& f)
    {
        for (int k = 0; k < 3; ++k) {
            const int a = f[k], b = f[(k + 1) % 3], c = f[(k + 2) % 3];
            if (const auto middle = middles_.find(std::minmax({ a, b })); middle != middles_.end()) {
                split({ c, a, middle->second });
                split({ c, middle->second, b });
                return;
            }
        }
        faces_.push_back(f);
    }

    std::vector<Vec3> points_;
    std::vector<Face> faces_;
    std::map<std::pair<int, int>, int> middles_;
};

TriangleMesh refined(const TriangleMesh& mesh, std::size_t vertices)
{
    TriangleMesh result = mesh;
    for (Refinement refinement(mesh); refinement.vertices() < vertices;)
        result = refinement.round(vertices);
    return result;
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

/// Closing and rigging, and the growth of the time with the vertices.
void rig(benchmark::State& state)
{
    const TriangleMesh man = refined(read(FIT_BODIES "/man_a_pose.ply"), std::size_t(state.range(0)));
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

void fit_to_garment(benchmark::State& state)
{
    const Rig rigged = rig_body(body());
    const GarmentMesh garment = coat(int(state.range(0)));
    for (auto _ : state)
        benchmark::DoNotOptimize(fit_skeleton(rigged, garment, as_coat()));
    count_vertices(state, garment.positions);
}
BENCHMARK(fit_to_garment)->DenseRange(0, 2)->Unit(benchmark::kSecond);

/// A skirt of so many vertices in which a body is rigged and posed.
struct Skirt {
    BodyMesh woman = body();
    Rig rigged = rig_body(woman);
    GarmentMesh garment;
    Pose pose;

    explicit Skirt(benchmark::State& state)
    {
        const TriangleMesh mesh = refined(read(FIT_SAMPLES "/skirt.ply"), std::size_t(state.range(0)));
        garment = make_garment(mesh.positions, mesh.triangles);
        pose = fit_skeleton(rigged, garment).pose;
        count_vertices(state, garment.positions);
        state.SetComplexityN(garment.positions.rows());
    }
};

void drape(benchmark::State& state)
{
    const Skirt skirt(state);
    for (auto _ : state)
        benchmark::DoNotOptimize(drape_garment(skirt.rigged, skirt.woman, skirt.pose, skirt.garment));
}

void recover(benchmark::State& state)
{
    const Skirt skirt(state);
    const DrapeResult draped = drape_garment(skirt.rigged, skirt.woman, skirt.pose, skirt.garment);
    for (auto _ : state)
        benchmark::DoNotOptimize(recover_pose(skirt.rigged, skirt.woman, skirt.pose, Pose(), draped.garments));
}

void cloth_sizes(benchmark::internal::Benchmark* run)
{
    for (const int vertices : { 3055, 4000, 8000, 15000, 30000, 60000 })
        run->Arg(vertices);
    run->Unit(benchmark::kSecond)->Complexity();
}
BENCHMARK(drape)->Apply(cloth_sizes);
BENCHMARK(recover)->Apply(cloth_sizes);

}  // namespace

BENCHMARK_MAIN();
