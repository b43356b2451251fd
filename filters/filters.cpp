// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/filters/filters.h"

#include <algorithm>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "attempt.h"
#include "garmentfit/filters/body_scale.h"
#include "garmentfit/filters/outcome.h"
#include "garmentfit/number_text.h"
#include "garmentfit/refined_body.h"
#include "garmentfit/stopwatch.h"
#include "near_origin.h"
#include "other_wearings.h"
#include "stages.h"
#include "stand_ins.h"
#include "tuning.h"

namespace garmentfit {
namespace {

struct StageRow {
    std::string_view name, progress_name;
    RunStage* run;
    double share;  ///< of the time that dressing takes, for the progress bar
};

constexpr std::array<StageRow, k_stage_count> k_stages { {
    { "rig", "rigging the body", rig_stage, 0.08 },
    { "fit", "fitting the skeleton", fit_stage, 0.12 },
    { "drape", "draping the garment", drape_stage, 0.4 },
    { "recover", "recovering the pose", recover_stage, 0.4 },
} };

constexpr int k_widening_rounds = 5;  // unit: what is wider at one part may be too small at the next
constexpr int k_vain_widenings = 2;  // unit: each is a whole run
constexpr int k_enlarging_rounds = 2;  // unit: cloth that is larger lies elsewhere, and may be a little too small there

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
void run_stage(const StageRow& stage, RunStage& run, Scene& scene, const Parameters& parameters,
               const Progress& progress)
{
    try {
        progress.goes_on(0);  // draping and recovering return something at any time
        run(scene, parameters, progress);
    } catch (const TimeLimitReached&) {
        throw TimeLimitReached("time_limit: it was reached while " + std::string(stage.progress_name)
                               + ", before there was anything to show; give more, or 0 for no limit");
    }
}

RunStage& run_of(Stage stage, const std::vector<Stage>& stages)
{
    const bool is_on_the_way = stage == Stage::drape && stages.back() == Stage::recover;
    return is_on_the_way ? drape_on_the_way_stage : *row(stage).run;
}

double progress_share(const std::vector<Stage>& stages)
{
    double total = 0;
    for (const Stage stage : stages)
        total += row(stage).share;
    return total;
}

bool ends_here(const Scene& scene, Stage stage) { return stage == Stage::drape && !all_put_on(scene); }

void run_stages_once(const std::vector<Stage>& stages, Scene& scene, const Parameters& parameters,
                     const Progress& progress)
{
    const double total = progress_share(stages);
    double done = 0;
    for (const Stage stage : stages) {
        const Stopwatch watch(scene.seconds[static_cast<int>(stage)]);
        const double next = done + row(stage).share / total;
        const Progress slice = progress.part(done, next, row(stage).progress_name);
        run_stage(row(stage), run_of(stage, stages), scene, parameters, slice);
        slice.goes_on(1);
        done = next;
        if (ends_here(scene, stage))
            break;
    }
}

/// Runs draping and recovering again after a change of the scene. It stays so where that tells more.
/// @param change  @return whether there is anything to change
/// @param worst  outcome with which it stays so
/// @param stays  whether it does with such an outcome
/// @return whether it stays so
bool run_changed(
    const std::function<bool(Scene&)>& change, std::vector<Stage> stages, Scene& scene, const Parameters& parameters,
    const Progress& progress, Outcome worst = Outcome::too_small,
    const std::function<bool(const Scene&)>& stays = [](const Scene&) { return true; })
{
    Scene other = scene;
    if (progress.is_late() || !change(other))
        return false;
    stages.erase(std::remove_if(stages.begin(), stages.end(), [](Stage stage) { return stage < Stage::drape; }),
                 stages.end());
    other.recovered.reset();
    if (stages.front() == Stage::drape)
        other.draped.reset();
    const bool is_better = succeeds([&] { run_stages_once(stages, other, parameters, progress); })
        && outcome_of(*final_dressing(other)) <= worst && stays(other);
    if (is_better)
        scene = std::move(other);
    return is_better;
}

bool is_too_small(const Scene& scene) { return outcome_of(*final_dressing(scene)) == Outcome::too_small; }

/// Fits and puts on again garments that are too small, made wider where they are: wider cloth lies elsewhere. Where
/// that does not end well, cloth that is less wide may.
/// @param most  share by which girths grow at most
void run_wider(const std::vector<Stage>& stages, Scene& scene, const Parameters& parameters, double most,
               const Progress& progress)
{
    double share = 1;
    int vain = 0;
    for (int k = 0; k < k_widening_rounds && vain < k_vain_widenings && is_too_small(scene); ++k) {
        const auto widen = [&](Scene& other) {
            return widen_too_small(other, most, share) && fit_again(other, parameters, progress);
        };
        if (run_changed(widen, stages, scene, parameters, progress))
            continue;
        share *= k_smaller_share;
        ++vain;
    }
}

/// Puts clothes on once more as soft cloth that did not end well, and those that were too small as the knit that is usual
/// for their type, where nothing was said of their fabric.
void run_softly(const std::vector<Stage>& stages, Scene& scene, const Parameters& parameters, const Progress& progress)
{
    const auto change = [&](Scene& other) {
        if (!may_be_worn_in_the_end(other))
            return false;
        take_usual_knits(other, parameters);
        return true;
    };
    run_changed(change, stages, scene, putting_on_softly(parameters), progress, Outcome::done,
                [](const Scene& other) { return !is_knit_stretched_all_over(other); });
}

void run_changes(const std::vector<Stage>& stages, Scene& scene, const Parameters& parameters, const Progress& progress)
{
    const bool puts_on = stages.front() <= Stage::drape, moves = stages.back() == Stage::recover;
    run_changed(give_up_stand_ins, stages, scene, parameters, progress);
    if (puts_on && moves)
        run_softly(stages, scene, parameters, progress);
    run_changed(find_linings, stages, scene, parameters, progress,
                is_too_small(scene) ? Outcome::done : Outcome::too_small);
    const Parameters slowly = growing_slowly(parameters);
    if (puts_on)
        run_changed(is_caught, stages, scene, slowly, progress, Outcome::done);
    if (moves)
        run_changed(is_caught, stages, scene, moving_slowly(slowly), progress, Outcome::done);
    for (const double size : k_looser_sizes)
        run_changed([&](Scene& other) { return loosen(other, size); }, stages, scene, parameters, progress,
                    Outcome::done);
}

void run_larger(const std::vector<Stage>& stages, Scene& scene, const Parameters& parameters, const Progress& progress)
{
    for (int k = 0; k < k_enlarging_rounds; ++k)
        run_changed([&](Scene& other) { return enlarge_too_small(other, parameters); }, stages, scene, parameters,
                    progress);
}

/// The same, but garments that are far too narrow are made wider before they are put on.
void run_stages_wider(const std::vector<Stage>& stages, Scene& scene, const Parameters& parameters, double most,
                      const Progress& progress)
{
    const auto first = std::find(stages.begin(), stages.end(), Stage::drape);
    const double share = progress_share({ stages.begin(), first }) / progress_share(stages);
    run_stages_once({ stages.begin(), first }, scene, parameters, progress.part(0, share));
    Scene wider = scene;
    if (widen_far_too_narrow(wider, parameters, most) && fit_again(wider, parameters, progress.part(share, share)))
        scene = std::move(wider);
    run_stages_once({ first, stages.end() }, scene, parameters, progress.part(share, 1));
}

/// @param fits  whether garments may be fitted anew: then they are made wider first, and larger, all of them alike, only
///              where that does not do
void run_stages(const std::vector<Stage>& stages, Scene& scene, const Parameters& parameters, const Progress& progress,
                bool fits)
{
    const bool widens = fits && stages.back() >= Stage::drape && parameters.drape.cloth.largest_enlargement > 0;
    Parameters of_girth = parameters;
    if (widens) {
        of_girth.drape.cloth.largest_enlargement = 0;
        run_stages_wider(stages, scene, of_girth, parameters.drape.cloth.largest_enlargement, progress);
    } else {
        run_stages_once(stages, scene, parameters, progress);
    }
    if (stages.back() < Stage::drape)
        return;
    const Progress again = progress.part(1, 1);
    run_changes(stages, scene, of_girth, again);
    if (!widens)
        return run_larger(stages, scene, parameters, again);
    Scene wider = scene;
    run_wider(stages, wider, of_girth, parameters.drape.cloth.largest_enlargement, again);
    if (is_too_small(wider)) {
        const auto nothing = [](Scene&) { return true; };
        run_changed(nothing, stages, scene, parameters, again);
        run_larger(stages, scene, parameters, again);
    }
    if (outcome_of(*final_dressing(wider)) <= outcome_of(*final_dressing(scene)))
        scene = std::move(wider);
}

void take_all_as_given(Scene& scene)
{
    for (std::size_t i = 0; i < scene.garments.size(); ++i) {
        for (auto* dressing : { &scene.draped, &scene.recovered })
            if (*dressing && (*dressing)->is_worn(i))
                (*dressing)->garments[i].size *= scene.garments[i].share;
        take_as_given(scene.garments[i]);
    }
}

void run_stages(const Filter& filter, Scene& scene, const Parameters& parameters, const Progress& progress)
{
    const bool tries_others
        = filter.has(Stage::fit) && filter.has(Stage::recover) && parameters.fit.method == FitMethod::fast;
    std::exception_ptr refusal;
    std::size_t refused = 0;
    try {
        run_stages(filter.stages, scene, parameters, progress, filter.has(Stage::fit));
    } catch (const RefusedGarment& error) {
        if (!tries_others)
            throw;
        refused = error.garment;
        refusal = std::current_exception();
    }
    if (!tries_others)
        return take_all_as_given(scene);
    const Progress again = progress.part(1, 1);
    const auto run = [&](std::vector<Stage> stages) {
        return [&, stages](Scene& s) { run_stages(stages, s, parameters, again, true); };
    };
    const DressingSteps steps { run({ Stage::fit }), run({ Stage::drape, Stage::recover }) };
    try_size_in_unit(scene, steps, again);
    try_other_wearings(scene, steps, refused, again);
    try_other_sizes(scene, steps, refused, again);
    take_all_as_given(scene);
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

/// As dressed on a refined body, with the vertices of the given one. Between poses large triangles may stand across
/// what lies close to the refined skin: it is certified again.
void take_back_refined(std::optional<Dressing>& dressing, const TriangleMesh& given)
{
    if (!dressing)
        return;
    const auto cut = [&](Positions& body) {
        if (body.rows() > given.positions.rows())
            body.conservativeResize(given.positions.rows(), 3);
    };
    cut(dressing->body);
    std::vector<Positions> kept;
    for (const WornGarment& garment : dressing->garments)
        kept.push_back(garment.positions);
    certify_as_kept(*dressing, given.triangles, kept);
    const auto is_unclean = [&](RecoverFrame& frame) {
        cut(frame.body);
        Dressing on_the_way = *dressing;
        on_the_way.body = frame.body;
        certify_as_kept(on_the_way, given.triangles, frame.garments);
        return !all_clean(on_the_way.garments);
    };
    auto& frames = dressing->frames;
    frames.erase(std::remove_if(frames.begin(), frames.end(), is_unclean), frames.end());
}

Outcome end_of(const Scene& scene)
{
    const Dressing& end = *final_dressing(scene);
    return all_clean(end.garments) ? outcome_of(end) : Outcome::not_certified;
}

/// Dresses the refined body. @return how that ends on the given one; none where it fails
std::optional<Outcome> run_refined(const Filter& filter, Scene& scene, const Parameters& parameters,
                                   const Progress& progress)
{
    RiggedBody given { *scene.body, *scene.rig }, refined = refine_body(given.body, given.rig);
    scene.body = std::move(refined.body);
    scene.rig = std::move(refined.rig);
    if (!succeeds([&] { run_stages(filter, scene, parameters, progress); }))
        return {};
    scene.body = std::move(given.body);
    scene.rig = std::move(given.rig);
    for (auto* dressing : { &scene.draped, &scene.recovered })
        take_back_refined(*dressing, scene.body->surface);
    return end_of(scene);
}

/// On the refined body; where that does not end well, and it ends no worse as it is, as it is.
void run_refined_first(const Filter& filter, Scene& scene, const Parameters& parameters, const Progress& progress)
{
    Scene refined = scene;
    const std::optional<Outcome> end = run_refined(filter, refined, parameters, progress);
    const Progress again = progress.part(1, 1);
    if (!end)
        return run_stages(filter, scene, parameters, again);
    const bool is_better = *end != Outcome::done && !progress.is_late()
        && succeeds([&] { run_stages(filter, scene, parameters, again); }) && end_of(scene) <= *end;
    if (!is_better)
        scene = std::move(refined);
}

/// On the body as it is; where that does not end well, and it ends better on the refined one, on that.
void run_refined_last(const Filter& filter, Scene& scene, const Parameters& parameters, const Progress& progress)
{
    Scene refined = scene;
    run_stages(filter, scene, parameters, progress);
    if (end_of(scene) == Outcome::done || progress.is_late())
        return;
    const std::optional<Outcome> end = run_refined(filter, refined, parameters, progress.part(1, 1));
    if (end && *end < end_of(scene))
        scene = std::move(refined);
}

/// A body may be dressed on a refined one where that begins and ends in the input pose.
void run_on_refined_body(const Filter& filter, Scene& scene, const Parameters& parameters, const Progress& progress)
{
    if (!filter.has(Stage::drape) || !filter.has(Stage::recover) || !has_triangles_to_refine(*scene.body))
        return run_stages(filter, scene, parameters, progress);
    const double share = filter.has(Stage::rig) ? row(Stage::rig).share : 0;
    if (filter.has(Stage::rig))
        run_stages_once({ Stage::rig }, scene, parameters, progress.part(0, share));
    const auto run = has_large_triangles(*scene.body) ? run_refined_first : run_refined_last;
    run(filter.on_known_rig(), scene, parameters, progress.part(share, 1));
}

void run_at_human_size(const Filter& filter, Scene& scene, Parameters parameters, const Progress& progress)
{
    const double factor = factor_to_human_size(*scene.body);
    if (factor == 1)
        return run_on_refined_body(filter, scene, parameters, progress);
    Scene copy = scale_scene(scene, factor);
    parameters.rig.joints = scale_joints(parameters.rig.joints, factor);
    run_on_copy([&] { run_on_refined_body(filter, copy, parameters, progress); },
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

Filter Filter::on_known_rig() const
{
    Filter filter = *this;
    filter.stages.erase(std::remove(filter.stages.begin(), filter.stages.end(), Stage::rig), filter.stages.end());
    filter.outputs.erase(std::remove(filter.outputs.begin(), filter.outputs.end(), Data::rig), filter.outputs.end());
    if (!filter.reads(Data::rig))
        filter.inputs.push_back(Data::rig);
    return filter;
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
