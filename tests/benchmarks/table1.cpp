// SPDX-License-Identifier: GPL-3.0-or-later

// Table 1 of [wu_2018_garment_fitting] with other data: eleven pairs, three methods, one run.
//
//   table1 [--all-of-scan] [PAIR ...]
//
// One thread is timed by processor time, which other programs hardly disturb; all threads by wall-clock time.
//
// fast     with all preparation: the best of five runs, with one thread and with all.
// paper    with the KD-tree, all threads, processor time. By scan, the paper's own O(n_G), the poses are the same; the
//          time is the number of queries times the mean time of k_timed_queries. --all-of-scan runs all of them.
// tisserand  as many evaluations as paper made, times the mean time of k_timed_surfaces, by scan: O(n_H n_G).
// E        of both poses by the paper's own metric, over the bones that the garment covers.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <numeric>
#include <string>
#include <vector>

#include <tbb/global_control.h>

#include "baselines/surface_metric.h"
#include "garmentfit/fit_skeleton.h"
#include "garmentfit/io.h"
#include "garmentfit/rig_body.h"
#include "nearest.h"
#include "parallel.h"
#include "posture.h"

namespace {

using namespace garmentfit;

constexpr int k_timed_queries = 20000, k_timed_surfaces = 8;  // unit: decide the precision of the times only

struct Row {
    const char* garment;
    GarmentType type;
    const char* body;
};

const Row k_rows[] = {
    { "g05_jacket", GarmentType::jacket, "b01_m_avg_A_6890" },
    { "g07_trousers", GarmentType::trousers, "b01_m_avg_A" },
    { "g09_dress", GarmentType::dress, "b01_m_avg_A_6890" },
    { "g12_suit", GarmentType::suit, "b01_m_avg_A_6890" },
    { "g03_blouse", GarmentType::blouse, "b01_m_avg_A_6890" },
    { "g01_tshirt", GarmentType::tshirt, "b01_m_avg_A_6890" },
    { "g08_skirt", GarmentType::skirt, "b01_m_avg_A_6890" },
    { "g11_twolayer", GarmentType::suit, "b01_m_avg_A_6890" },
    { "g04_hoodie", GarmentType::hoodie, "b01_m_avg_A_6890" },
    { "g02_longshirt", GarmentType::longsleeve, "b01_m_avg_A_6890" },
    { "g06_coat", GarmentType::coat, "b01_m_avg_A" },
};

TriangleMesh read(const std::string& name)
{
    const MeshFile file = MeshFile::read(std::string(GARMENTFIT_TABLE1) + "/" + name + ".ply");
    return { file.positions(), file.triangles() };
}

enum class Clock { wall, processor };

double now(Clock clock)
{
    if (clock == Clock::processor)
        return double(std::clock()) / CLOCKS_PER_SEC;
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

template <class Work>
double seconds(const Work& work, Clock clock)
{
    const double start = now(clock);
    work();
    return now(clock) - start;
}

/// With one thread, and with all there are.
struct Times {
    double one, all;
};

template <class Work>
Times times(const Work& work)
{
    Times result {};
    {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
        result.one = work(Clock::processor);
    }
    result.all = work(Clock::wall);
    return result;
}

double best_of_five(const Rig& rig, const GarmentMesh& garment, const FitOptions& options, Clock clock)
{
    double best = 1e300;
    for (int i = 0; i < 5; ++i)
        best = std::min(best, seconds([&] { fit_skeleton(rig, garment, options); }, clock));
    return best;
}

/// Of one query. A scan takes the same time at every place.
double scan_seconds(const Positions& points, Clock clock)
{
    const PointScan scan(points);
    std::vector<int> found(k_timed_queries);
    const double total = seconds(
        [&] {
            parallel_for(
                k_timed_queries, [&](int i) { found[i] = scan.index(1.1 * points.row(i % points.rows())); }, 64);
        },
        clock);
    return std::accumulate(found.begin(), found.end(), 0LL) < 0
        ? 0
        : total / k_timed_queries;  // uses the results, so that the compiler keeps the scan
}

double surface_seconds(const Rig& rig, const TriangleMesh& body, const GarmentMesh& garment, Clock clock)
{
    const SurfaceMetric metric(rig, body, garment, NearestSearch::scan);
    Posture posture { rig.skeleton.root, Eigen::Quaterniond::Identity(), {} };
    for (int b = 0; b < bone_count; ++b)
        posture.directions[b] = rig.skeleton.direction(b);
    const PlacedBones bones = place_bones(rig.skeleton, posture);
    std::vector<double> found(k_timed_surfaces);
    const double total
        = seconds([&] { parallel_for(k_timed_surfaces, [&](int i) { found[i] = metric.total(bones); }); }, clock);
    return total / k_timed_surfaces;
}

double energy(const Rig& rig, const Pose& pose, const GarmentMesh& garment, const std::vector<Bone>& covered)
{
    const auto scores = paper_scores(rig, pose, garment, covered);
    return std::accumulate(scores.begin(), scores.end(), 0.0);
}

Times operator*(double factor, const Times& t) { return { factor * t.one, factor * t.all }; }

void print_row(int number, const Row& row, const Rig& rig, const TriangleMesh& body, bool all_of_scan)
{
    const TriangleMesh cloth = read(row.garment);
    const GarmentMesh garment = make_garment(cloth.positions, cloth.triangles);
    FitOptions options;
    options.type = row.type;
    const Times fast = times([&](Clock clock) { return best_of_five(rig, garment, options, clock); });
    const FitResult fast_result = fit_skeleton(rig, garment, options);

    options.method = FitMethod::paper;
    FitResult paper_result;
    const double tree = seconds([&] { paper_result = fit_skeleton(rig, garment, options); }, Clock::processor);
    const double evaluations = double(paper_result.evaluations + paper_result.bone_evaluations);
    const double queries = 5.0
        * (double(paper_result.evaluations) * double(paper_result.covered.size())
           + double(paper_result.bone_evaluations));
    Times scan = queries * times([&](Clock clock) { return scan_seconds(garment.positions, clock); });
    if (all_of_scan) {
        options.nearest = NearestSearch::scan;
        scan.all = seconds([&] { fit_skeleton(rig, garment, options); }, Clock::wall);
    }
    const Times tisserand
        = evaluations * times([&](Clock clock) { return surface_seconds(rig, body, garment, clock); });

    std::printf("| %d | %s | %ld / %ld | %ld / %ld | %.3f / %.3f | %.1f | %.0f / %.0f%s | %.0f / %.0f | %.0f / %.0f | "
                "%.0f / %.0f | %.3f | %.3f |\n",
                number, row.garment, long(cloth.positions.rows()), long(cloth.triangles.rows()),
                long(body.positions.rows()), long(body.triangles.rows()), fast.one, fast.all, tree, scan.one, scan.all,
                all_of_scan ? " (all of it)" : "", tisserand.one, tisserand.all, scan.one / fast.one,
                scan.all / fast.all, tisserand.one / fast.one, tisserand.all / fast.all,
                energy(rig, fast_result.pose, garment, paper_result.covered),
                energy(rig, paper_result.pose, garment, paper_result.covered));
    std::fflush(stdout);
}

struct RiggedBody {
    TriangleMesh mesh;
    Rig rig;
};

RiggedBody rigged(const std::string& name)
{
    const TriangleMesh mesh = read(name);
    return { mesh, rig_body(make_body(mesh.positions, mesh.triangles)) };
}

}  // namespace

int main(int argc, char** argv)
{
    bool all_of_scan = false;
    std::vector<int> wanted;
    for (int i = 1; i < argc; ++i)
        if (argv[i] == std::string("--all-of-scan"))
            all_of_scan = true;
        else
            wanted.push_back(std::stoi(argv[i]));
    const RiggedBody small = rigged("b01_m_avg_A_6890"), large = rigged("b01_m_avg_A");
    std::printf("Seconds and ratios: one thread (processor time) / %zu threads. By scan: extrapolated from %d queries, "
                "and from %d "
                "surfaces for tisserand.\n\n"
                "| pair | garment | v / f | body v / f | fast, s | paper by KD-tree, s | paper by scan, s | tisserand, "
                "s | paper by scan : fast "
                "| tisserand : fast | E fast | E paper |\n"
                "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n",
                tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism), k_timed_queries,
                k_timed_surfaces);
    for (int number = 1; number <= int(std::size(k_rows)); ++number) {
        const Row& row = k_rows[number - 1];
        const RiggedBody& body = row.body == std::string("b01_m_avg_A") ? large : small;
        if (wanted.empty() || std::find(wanted.begin(), wanted.end(), number) != wanted.end())
            print_row(number, row, body.rig, body.mesh, all_of_scan);
    }
}
