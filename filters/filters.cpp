// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/filters/filters.h"

#include <algorithm>
#include <exception>
#include <functional>
#include <limits>
#include <numeric>
#include <string>

#include "garmentfit/filters/body_scale.h"
#include "garmentfit/filters/outcome.h"
#include "garmentfit/number_text.h"
#include "garmentfit/stopwatch.h"
#include "near_origin.h"
#include "other_wearings.h"
#include "stand_ins.h"

namespace garmentfit {
namespace {

// ---- what each stage does to the scene -------------------------------------------------------------------------

void rig(Scene& scene, const Parameters& p, const Progress& progress)
{
    scene.rig = rig_body(*scene.body, p.rig, progress);
}

/// "coat.obj: "; a garment without a name is "garment 2: " where there are several.
std::string prefix_of(const Scene& scene, std::size_t garment)
{
    const std::string& name = scene.garments[garment].name;
    if (!name.empty())
        return name + ": ";
    return scene.garments.size() > 1 ? "garment " + std::to_string(garment + 1) + ": " : "";
}

/// What work(i) returns; an error names the garment.
template <class Work>
auto for_garment(const Scene& scene, std::size_t i, const Work& work)
{
    try {
        return work(i);
    } catch (const InvalidInput& error) {
        throw InvalidInput(error.code(), prefix_of(scene, i) + error.what());
    } catch (const SolverFailure& error) {
        throw SolverFailure(prefix_of(scene, i) + error.what());
    }
}

void require_wearable_sizes(const Scene& scene)
{
    for (std::size_t g = 0; g < scene.garments.size(); ++g)
        for_garment(scene, g, [&](std::size_t i) { require_wearable_size(*scene.rig, scene.garments[i].mesh); });
}

std::vector<GarmentMesh> meshes_of(const std::vector<GarmentInput>& garments)
{
    std::vector<GarmentMesh> meshes;
    for (const GarmentInput& garment : garments)
        meshes.push_back(garment.mesh);
    return meshes;
}

/// Finds one pose for all garments; where there is none, each keeps the pose of its fit.
void fit_together(Scene& scene, const Progress& progress)
{
    const CommonFit common = fit_common_pose(*scene.rig, meshes_of(scene.garments), scene.fits, progress);
    scene.fits = common.fits;
    scene.one_pose = common.one_pose;
    scene.conflicts = common.conflicts;
}

void put_in_layers(Scene& scene, LayerOrder order)
{
    if (scene.garments.size() < 2)
        return;
    scene.automatic_layers
        = order_layers(*scene.rig, scene.body->surface.positions, meshes_of(scene.garments), scene.fits);
    for (std::size_t i = 0; i < scene.fits.size(); ++i)
        scene.fits[i].layer = order == LayerOrder::automatic ? scene.automatic_layers[i] : int(i);
}

void fit_all(Scene& scene, const Parameters& p, const Progress& progress)
{
    scene.fits.clear();
    scene.one_pose.reset();
    scene.conflicts.clear();
    scene.automatic_layers.clear();
    require_wearable_sizes(scene);
    const bool together = scene.garments.size() > 1 && p.fit.method == FitMethod::fast;
    const double n = double(scene.garments.size()) + (together ? 1 : 0);
    for (std::size_t g = 0; g < scene.garments.size(); ++g)
        scene.fits.push_back(for_garment(scene, g, [&](std::size_t i) {
            const GarmentInput& garment = scene.garments[i];
            FitOptions options = p.fit;
            if (garment.type != GarmentType::automatic)
                options.type = garment.type;
            if (garment.front)
                options.front = garment.front;
            options.as_placed = garment.as_placed.value_or(options.as_placed);
            options.skipped += garment.skipped;
            return fit_skeleton(*scene.rig, scene.body->surface, garment.mesh, options,
                                progress.part(double(i) / n, double(i + 1) / n));
        }));
    if (together)
        fit_together(scene, progress.part(1 - 1 / n, 1));
    put_in_layers(scene, p.layer_order);
}

/// The dressing with some of the scene's garments only, in the order of `which`: libfit has them from the inside out.
Dressing select(const Dressing& all, const std::vector<std::size_t>& which)
{
    Dressing some = all;
    some.garments.clear();
    for (const std::size_t i : which)
        some.garments.push_back(all.garments[i]);
    return some;
}

template <class OfOne>
void spread(std::vector<OfOne>& some, const std::vector<std::size_t>& which, std::size_t count)
{
    std::vector<OfOne> all(count);
    for (std::size_t k = 0; k < some.size(); ++k)
        all[which[k]] = std::move(some[k]);
    some = std::move(all);
}

/// The reverse of select: one entry for each of the scene's garments, empty where it is not worn.
Dressing among_all(Dressing some, const std::vector<std::size_t>& which, std::size_t count)
{
    spread(some.garments, which, count);
    spread(some.maps, which, count);
    spread(some.girths, which, count);
    spread(some.overstretches, which, count);
    spread(some.loads, which, count);
    for (RecoverFrame& frame : some.frames)
        spread(frame.garments, which, count);
    return some;
}

std::vector<TooTight> among_all(std::vector<TooTight> parts, const std::vector<std::size_t>& which)
{
    for (TooTight& part : parts)
        part.garment = int(which[part.garment]);
    return parts;
}

Dressing dressing_of(const DrapeResult& result)
{
    Dressing dressing;
    static_cast<DressedBody&>(dressing) = result;
    dressing.scale_reached = result.scale_reached;
    dressing.held_back = result.held_back;
    dressing.speed = result.speed;
    dressing.seconds = result.seconds;
    dressing.certified = result.certified;
    if (result.out_of_time)
        dressing.out_of_time = Stage::drape;
    return dressing;
}

/// What is left to do at the time limit is left out.
Dressing end_at_time_limit(Dressing dressing, Stage stage)
{
    if (!dressing.out_of_time)
        dressing.out_of_time = stage;
    dressing.certified = false;
    return dressing;
}

/// Moves a dressed body to another pose. Returns the start where the end is not free of crossings.
/// @param worn  which of the scene's garments those of the dressing are; more may follow
Dressing move_to_pose(const Scene& scene, const Dressing& from, const std::vector<std::size_t>& worn, const Pose& to,
                      const RecoverOptions& options, Stage stage, const Progress& progress)
{
    if (progress.is_late()) {
        Dressing next = end_at_time_limit(from, stage);
        next.pose_reached = 0;
        next.frames_asked = options.frames;
        return next;
    }
    const RecoverResult result = recover_pose(*scene.rig, scene.body.value(), from, to, options, progress);
    Dressing next = from;
    next.certified = result.certified;
    next.pose_reached = result.pose_reached;
    next.held_back = result.held_back;
    next.overlaps = result.overlaps;
    next.seconds += result.seconds;
    next.frames = result.frames;
    next.frames_asked = options.frames;
    next.out_of_time = result.out_of_time ? std::optional(stage) : std::nullopt;
    if (!all_clean(result.garments)) {
        next.pose_reached = 0;
        return next;
    }
    next.too_tight = among_all(result.too_tight, worn);
    static_cast<DressedBody&>(next) = result;
    next.speed = result.speed;
    next.residual = result.residual;
    return next;
}

void measure(const Scene& scene, Dressing& dressing, const ClothOptions& cloth)
{
    const TriangleMesh body { dressing.body, scene.body->surface.triangles };
    const Skeleton skeleton = pose_skeleton(scene.rig->skeleton, dressing.pose);
    dressing.spikes = find_spikes(*scene.rig, *scene.body, dressing);
    dressing.spiked_share = dressing.spikes.edges / (1.5 * double(scene.body->surface.triangles.rows()));
    dressing.loads.clear();
    dressing.maps.clear();
    dressing.girths.clear();
    dressing.overstretches.clear();
    for (const WornGarment& garment : dressing.garments) {
        dressing.maps.push_back(fit_map(body, garment, cloth));
        dressing.girths.push_back(girths(skeleton, scene.rig->weights, body, garment));
        const double limit = std::max(k_overstretched, material_of(garment.fabric.value_or(cloth.fabric)).strain_limit);
        dressing.overstretches.push_back(overstretch(scene.rig->weights, dressing.body, garment, limit));
        dressing.loads.push_back(part_loads(skeleton, scene.rig->weights, dressing.body, garment, cloth));
    }
}

/// What the scene's garments are made of, and the unit of messages about them.
void write_given(const Scene& scene, Dressing& dressing, const ClothOptions& cloth)
{
    dressing.unit = scene.unit;
    dressing.fabrics.clear();
    dressing.fabric_stretches.clear();
    for (const GarmentInput& garment : scene.garments) {
        dressing.fabrics.push_back(garment.fabric.value_or(cloth.fabric));
        dressing.fabric_stretches.push_back(material_of(cloth, dressing.fabrics.back()).largest_stretch);
    }
}

/// The options of one garment among several.
DrapeOptions options_for(const GarmentInput& garment, DrapeOptions options)
{
    options.cloth.fabric = garment.fabric.value_or(options.cloth.fabric);
    return options;
}

std::vector<std::size_t> from_inside_out(const std::vector<FitResult>& fits)
{
    std::vector<std::size_t> order(fits.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return fits[a].layer < fits[b].layer; });
    return order;
}

/// @throws RefusedGarment where the cloth lies across the bones of the body
DrapeResult drape_next(const Scene& scene, std::size_t garment, const Dressing& dressing, const DrapeOptions& options,
                       const Progress& progress)
try {
    return for_garment(scene, garment, [&](std::size_t i) {
        return drape_garment(*scene.rig, *scene.body, dressing, scene.garments[i].mesh,
                             options_for(scene.garments[i], options), progress);
    });
} catch (const InvalidInput& error) {
    if (error.code() == ErrorCode::crossing_start)
        throw RefusedGarment(garment, error.what());
    throw;
}

/// Puts the garments on from the inside out. Those already worn move to the pose of the next one. Ends at the first
/// that cannot be put on.
void drape_all(Scene& scene, const Parameters& p, const Progress& progress)
{
    Dressing dressing;
    RecoverOptions between_poses = p.recover;
    between_poses.frames = 0;
    between_poses.quality = Quality::draft;
    between_poses.cloth.largest_stretch
        = std::numeric_limits<double>::infinity();  // a garment is judged in the pose that it is worn in
    const double n = double(scene.garments.size());
    require_wearable_sizes(scene);
    const std::vector<std::size_t> order = from_inside_out(scene.fits);
    for (std::size_t layer = 0; layer < order.size(); ++layer) {
        const Progress slice = progress.part(double(layer) / n, double(layer + 1) / n);
        const Pose& pose = scene.fits[order[layer]].pose;
        if (layer > 0 && !is_same(dressing.pose, pose))
            dressing = move_to_pose(scene, dressing, order, pose, between_poses, Stage::drape, slice.part(0, 0.3));
        if (layer > 0 && slice.is_late())
            dressing = end_at_time_limit(std::move(dressing), Stage::drape);
        if (layer > 0 && !dressing.certified)
            break;
        dressing.pose = pose;
        const DrapeResult result
            = drape_next(scene, order[layer], dressing, p.drape, slice.part(layer > 0 ? 0.3 : 0, 1));
        const ClothSeconds before = dressing.seconds;
        const std::size_t worn_before = dressing.garments.size();
        dressing = dressing_of(result);
        if (dressing.garments.size() > worn_before)
            dressing.garments.back().fabric = scene.garments[order[layer]].fabric;
        dressing.too_tight = among_all(result.too_tight, order);
        dressing.outermost = order[layer];
        dressing.seconds += before;
        if (!dressing.certified)
            break;
    }
    measure(scene, dressing, p.drape.cloth);
    scene.draped = among_all(dressing, order, order.size());
    write_given(scene, *scene.draped, p.drape.cloth);
}

/// Without fits, the garments are in the order in which they were given.
std::vector<std::size_t> worn_from_inside_out(const Scene& scene, const Dressing& dressing)
{
    std::vector<std::size_t> worn = dressing.worn();
    if (scene.fits.size() == scene.garments.size())
        std::stable_sort(worn.begin(), worn.end(),
                         [&](std::size_t a, std::size_t b) { return scene.fits[a].layer < scene.fits[b].layer; });
    return worn;
}

void recover(Scene& scene, const Parameters& p, const Progress& progress)
{
    const std::vector<std::size_t> worn = worn_from_inside_out(scene, *scene.draped);
    Dressing draped = select(*scene.draped, worn);
    for (std::size_t k = 0; k < worn.size(); ++k)
        draped.garments[k].fabric = scene.garments[worn[k]].fabric;
    Dressing recovered = move_to_pose(scene, draped, worn, Pose(), p.recover, Stage::recover, progress);
    measure(scene, recovered, p.recover.cloth);
    recovered.certified &= all_put_on(scene);
    scene.recovered = among_all(recovered, worn, scene.garments.size());
    write_given(scene, *scene.recovered, p.recover.cloth);
}

using RunStage = void(Scene&, const Parameters&, const Progress&);

/// Runs a stage with stand-ins in the places of garments that need one.
/// @param output  where it puts its dressing
void run_with_stand_ins(RunStage& stage, std::optional<Dressing> Scene::*output, Scene& scene, const Parameters& p,
                        const ClothOptions& cloth, const Progress& progress)
{
    if (!find_stand_ins(scene))
        return stage(scene, p, progress);
    Scene led = lead(scene);
    stage(led, p, progress);
    const std::vector<std::size_t> order = worn_from_inside_out(scene, *(led.*output));
    scene.*output = follow_stand_ins({ scene, led, order }, *std::move(led.*output), cloth);
}

void drape_stage(Scene& scene, const Parameters& p, const Progress& progress)
{
    run_with_stand_ins(drape_all, &Scene::draped, scene, p, p.drape.cloth, progress);
}

void recover_stage(Scene& scene, const Parameters& p, const Progress& progress)
{
    run_with_stand_ins(recover, &Scene::recovered, scene, p, p.recover.cloth, progress);
}

// ---- the tables ------------------------------------------------------------------------------------------------

struct StageRow {
    std::string_view name, progress_name;
    void (*run)(Scene&, const Parameters&, const Progress&);
    double share;  ///< of the time that dressing takes, for the progress bar
};

constexpr std::array<StageRow, k_stage_count> k_stages { {
    { "rig", "rigging the body", rig, 0.08 },
    { "fit", "fitting the skeleton", fit_all, 0.12 },
    { "drape", "draping the garment", drape_stage, 0.4 },
    { "recover", "recovering the pose", recover_stage, 0.4 },
} };

const StageRow& row(Stage stage) { return k_stages[static_cast<int>(stage)]; }

void require(bool given, const Filter& filter, const char* what)
{
    if (!given)
        throw InvalidInput(ErrorCode::missing_input, std::string(filter.label) + ": " + what);
}

void require_inputs(const Filter& filter, const Scene& scene)
{
    for (const Data input : filter.inputs)
        switch (input) {
        case Data::body: require(scene.body.has_value(), filter, "there is no body; give one"); break;
        case Data::garments: require(!scene.garments.empty(), filter, "there is no garment; give at least one"); break;
        case Data::rig: require(scene.rig.has_value(), filter, "the body has no rig; run Rig Body first"); break;
        case Data::fits:
            require(scene.fits.size() == scene.garments.size(), filter,
                    "the body is not fitted to each of the garments; run Fit Skeleton with these garments first");
            break;
        case Data::draped:
            require(scene.draped.has_value(), filter, "no garment is draped; run Drape Garment first");
            break;
        case Data::recovered: break;  // no filter reads it
        }
}

/// @throws TimeLimitReached with a line that says which stage takes longer, and what to do
void run_stage(const StageRow& stage, Scene& scene, const Parameters& parameters, const Progress& progress)
{
    try {
        progress.goes_on(0);  // draping and recovering return something at any time
        stage.run(scene, parameters, progress);
    } catch (const TimeLimitReached&) {
        throw TimeLimitReached("time_limit: it was reached while " + std::string(stage.progress_name)
                               + ", before there was anything to show; give more, or 0 for no limit");
    }
}

bool ends_here(const Scene& scene, Stage stage) { return stage == Stage::drape && !all_put_on(scene); }

void run_stages(const std::vector<Stage>& stages, Scene& scene, const Parameters& parameters, const Progress& progress)
{
    double total = 0, done = 0;
    for (const Stage stage : stages)
        total += row(stage).share;
    for (const Stage stage : stages) {
        const Stopwatch watch(scene.seconds[static_cast<int>(stage)]);
        const double next = done + row(stage).share / total;
        const Progress slice = progress.part(done, next, row(stage).progress_name);
        run_stage(row(stage), scene, parameters, slice);
        slice.goes_on(1);
        done = next;
        if (ends_here(scene, stage))
            break;
    }
}

void run_stages(const Filter& filter, Scene& scene, const Parameters& parameters, const Progress& progress)
{
    const bool tries_others
        = filter.has(Stage::fit) && filter.has(Stage::recover) && parameters.fit.method == FitMethod::fast;
    std::exception_ptr refusal;
    std::size_t refused = 0;
    try {
        run_stages(filter.stages, scene, parameters, progress);
    } catch (const RefusedGarment& error) {
        if (!tries_others)
            throw;
        refused = error.garment;
        refusal = std::current_exception();
    }
    if (!tries_others)
        return;
    const Progress again = progress.part(1, 1);
    const auto run = [&](std::vector<Stage> stages) {
        return [&, stages](Scene& s) { run_stages(stages, s, parameters, again); };
    };
    try_other_wearings(scene, { run({ Stage::fit }), run({ Stage::drape, Stage::recover }) }, refused, again);
    if (refusal && !final_dressing(scene))
        std::rethrow_exception(refusal);
}

/// Runs on a copy of the scene. What was made is taken back, also by the stages before one that fails.
/// @param remark  an error's lengths and places are those of the copy, and its line says so
void run_on_copy(const std::function<void()>& run, const std::function<void()>& take_back, const std::string& remark)
{
    try {
        try {
            run();
        } catch (...) {
            take_back();
            throw;
        }
        take_back();
    } catch (const InvalidInput& error) {
        throw InvalidInput(error.code(), error.what() + remark);
    } catch (const SolverFailure& error) {
        throw SolverFailure(error.what() + remark);
    }
}

void run_at_human_size(const Filter& filter, Scene& scene, Parameters parameters, const Progress& progress)
{
    const double factor = factor_to_human_size(*scene.body);
    if (factor == 1)
        return run_stages(filter, scene, parameters, progress);
    Scene copy = scale_scene(scene, factor);
    parameters.rig.joints = scale_joints(parameters.rig.joints, factor);
    run_on_copy([&] { run_stages(filter, copy, parameters, progress); },
                [&] { restore_size(scene, copy, factor, filter.outputs); },
                " (lengths as on a body of human size, that is times " + rounded_text(factor, 6) + ")");
}

void run_near_origin(const Filter& filter, Scene& scene, Parameters parameters, const Progress& progress)
{
    constexpr int k_digits = 9;  // unit: far away, the last metre is what counts
    const Origins origins = origins_of(scene);
    if (origins.all_zero())
        return run_at_human_size(filter, scene, parameters, progress);
    Scene copy = move_to_origin(scene, origins);
    parameters.rig.joints = move_to_origin(parameters.rig.joints, origins);
    const auto along = [&](int axis) { return rounded_text(origins.body[axis], k_digits); };
    run_on_copy([&] { run_at_human_size(filter, copy, parameters, progress); },
                [&] { move_back(scene, copy, origins, filter.outputs); },
                " (places as seen from " + along(0) + ", " + along(1) + ", " + along(2) + " m)");
}

}  // namespace

std::string_view name_of(Stage stage) { return row(stage).name; }

std::vector<std::size_t> Dressing::worn() const
{
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < garments.size(); ++i)
        if (is_worn(i))
            result.push_back(i);
    return result;
}

void put_body(Scene& scene, const Frame& frame, const Positions& in_file, const Triangles& triangles)
{
    scene.unit = unit_of(frame);
    scene.body = make_body(frame.to_metres(in_file), triangles);
}

std::size_t outermost(const std::vector<FitResult>& fits)
{
    const auto last = std::max_element(fits.rbegin(), fits.rend(),
                                       [](const FitResult& a, const FitResult& b) { return a.layer < b.layer; });
    return fits.rend() - last - 1;
}

const std::vector<Filter>& filters()
{
    static const std::vector<Filter> table {
        { "rig",
          "Rig Body",
          "Finds the skeleton of a body, and how much each bone moves each vertex of the skin",
          { Data::body },
          { Data::rig },
          { Stage::rig } },
        { "fit",
          "Fit Skeleton",
          "Poses the skeleton of a body so that its bones run through the middle of the garment's sleeves, legs and "
          "trunk",
          { Data::body, Data::garments, Data::rig },
          { Data::fits },
          { Stage::fit } },
        { "drape",
          "Drape Garment",
          "Puts the garment on the body in the fitted pose, without crossings of cloth and body",
          { Data::body, Data::garments, Data::rig, Data::fits },
          { Data::draped },
          { Stage::drape } },
        { "recover",
          "Recover Pose",
          "Returns the dressed body to its input pose, together with the garment",
          { Data::body, Data::garments, Data::rig, Data::draped },
          { Data::recovered },
          { Stage::recover } },
        { "dress",
          "Dress Body",
          "Dresses a body in garments made for another body: rig, fit, drape, recover",
          { Data::body, Data::garments },
          { Data::rig, Data::fits, Data::draped, Data::recovered },
          { Stage::rig, Stage::fit, Stage::drape, Stage::recover } },
    };
    return table;
}

const Filter& filter_of(std::string_view name)
{
    std::string names;
    for (const Filter& filter : filters()) {
        if (filter.name == name)
            return filter;
        names += (names.empty() ? "" : ", ") + std::string(filter.name);
    }
    throw InvalidInput(ErrorCode::unknown_name,
                       "no filter is called \"" + std::string(name) + "\"; give one of " + names);
}

bool Filter::has(Stage stage) const { return std::find(stages.begin(), stages.end(), stage) != stages.end(); }

bool Filter::reads(Data data) const { return std::find(inputs.begin(), inputs.end(), data) != inputs.end(); }

bool Filter::makes(Data data) const { return std::find(outputs.begin(), outputs.end(), data) != outputs.end(); }

const ClothOptions& Filter::cloth(const Parameters& parameters) const
{
    return has(Stage::drape) ? parameters.drape.cloth : parameters.recover.cloth;
}

void Filter::run(Scene& scene, const Parameters& parameters, const Progress& progress) const
{
    require_inputs(*this, scene);
    describe(*this, parameters, CheckRanges());
    Parameters p = parameters;
    p.recover.cloth = cloth(parameters);
    const Progress limited = progress.until(Deadline::in(p.time_limit));
    run_near_origin(*this, scene, p, limited);
}

}  // namespace garmentfit
