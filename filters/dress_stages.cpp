// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "garmentfit/filters/outcome.h"
#include "garmentfit/filters/verdict.h"
#include "garmentfit/hips.h"
#include "garmentfit/shoulders.h"
#include "named_garment.h"
#include "other_wearings.h"
#include "stand_ins.h"
#include "tuning.h"

namespace garmentfit {
namespace {

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

/// The shoulders that one of the scene's garments lay over in its fit, and lies over no longer.
std::vector<Bone> slipped_off(const Scene& scene, const Dressing& dressing, std::size_t garment)
{
    if (!dressing.is_worn(garment) || garment >= scene.fits.size())
        return {};
    const Skeleton& rest = scene.rig->skeleton;
    const GarmentMesh& given = scene.garments[garment].mesh;
    const WornGarment& worn = dressing.garments[garment];
    std::vector<Bone> off
        = shoulders_under_cloth(pose_skeleton(rest, scene.fits[garment].pose), given.positions, given.triangles);
    for (const Bone under :
         shoulders_under_cloth(pose_skeleton(rest, dressing.pose), worn.positions, worn.rest.triangles))
        std::erase(off, under);
    return off;
}

/// The hips that one of the scene's garments covers in its fit, and does not reach.
std::vector<Bone> below_hips(const Scene& scene, const Dressing& dressing, std::size_t garment)
{
    if (!dressing.is_worn(garment) || garment >= scene.fits.size())
        return {};
    const std::vector<Bone>& covered = scene.fits[garment].covered;
    const WornGarment& worn = dressing.garments[garment];
    std::vector<Bone> below { lhipjoint, rhipjoint };
    std::erase_if(below, [&](Bone hip) { return std::find(covered.begin(), covered.end(), hip) == covered.end(); });
    if (below.empty())
        return below;
    const Skeleton& rest = scene.rig->skeleton;
    for (const Bone reached :
         hips_under_cloth(pose_skeleton(rest, dressing.pose), crotch_depth(rest, scene.body->closed), worn.positions,
                          worn.rest.triangles))
        std::erase(below, reached);
    return below;
}

/// What the scene's garments are made of, the unit of messages about them, the shoulders that they slipped off, and the
/// hips that they do not reach.
void write_given(const Scene& scene, Dressing& dressing, const ClothOptions& cloth)
{
    dressing.unit = scene.unit;
    dressing.fabrics.clear();
    dressing.guessed_fabrics.clear();
    dressing.fabric_stretches.clear();
    dressing.off_shoulders.clear();
    for (std::size_t i = 0; i < scene.garments.size(); ++i)
        dressing.off_shoulders.push_back(slipped_off(scene, dressing, i));
    dressing.below_hips.clear();
    for (std::size_t i = 0; i < scene.garments.size(); ++i)
        dressing.below_hips.push_back(below_hips(scene, dressing, i));
    for (const GarmentInput& garment : scene.garments) {
        dressing.fabrics.push_back(garment.fabric.value_or(cloth.fabric));
        dressing.guessed_fabrics.push_back(garment.fabric_is_guessed);
        dressing.fabric_stretches.push_back(material_of(cloth, dressing.fabrics.back()).largest_stretch);
    }
}

/// Whether the cloth has figures that are not its fabric's.
bool has_own_figures(const ClothOptions& cloth)
{
    return cloth.density || cloth.stretch_stiffness || cloth.bend_stiffness || cloth.friction || cloth.largest_stretch
        || cloth.weft_to_warp || cloth.shear_stiffness;
}

/// None where most garments of the type are woven, or may be either.
std::optional<Fabric> usual_knit(GarmentType type)
{
    const auto found = std::find_if(k_usual_knits.begin(), k_usual_knits.end(),
                                    [&](const UsualKnit& knit) { return knit.type == type; });
    return found != k_usual_knits.end() ? std::optional(found->fabric) : std::nullopt;
}

/// The options of one garment among several.
DrapeOptions options_for(const GarmentInput& garment, DrapeOptions options)
{
    options.cloth.fabric = garment.fabric.value_or(options.cloth.fabric);
    options.size = garment.size;
    if (!garment.has_unit)
        options.cloth.largest_enlargement = std::max(options.cloth.largest_enlargement, k_enlarged_without_unit);
    return options;
}

void add_given(WornGarment& worn, const GarmentInput& garment)
{
    worn.fabric = garment.fabric;
    worn.girth = largest_factor(garment.widening);
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
            add_given(dressing.garments.back(), scene.garments[order[layer]]);
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

/// All that is worn, in another pose.
Dressing moved(const Scene& scene, const Dressing& dressing, const Pose& to, const RecoverOptions& options, Stage stage,
               const Progress& progress)
{
    const std::vector<std::size_t> worn = worn_from_inside_out(scene, dressing);
    Dressing from = select(dressing, worn);
    for (std::size_t k = 0; k < worn.size(); ++k)
        from.garments[k].fabric = scene.garments[worn[k]].fabric;
    Dressing result = move_to_pose(scene, from, worn, to, options, stage, progress);
    measure(scene, result, options.cloth);
    for (const std::size_t i : result.worn())
        result.certified &= !is_drawn_out(result, i) && !has_fallen_off(result, i);
    result = among_all(result, worn, scene.garments.size());
    write_given(scene, result, options.cloth);
    return result;
}

/// The factor by which the fabric of a garment that is made larger may give.
double given_by_larger(double fabric_stretch) { return 1 + k_stretch_of_enlarged * fabric_stretch; }

/// Girths of body and garment as they are fitted.
std::vector<Girth> girths_in_fit(const Scene& scene, std::size_t garment)
{
    const Rig& rig = *scene.rig;
    const Pose& pose = scene.fits[garment].pose;
    const auto& [positions, triangles] = scene.body->surface;
    const TriangleMesh body { skin(positions, rig.weights, bone_transforms(rig.skeleton, pose)), triangles };
    const GarmentMesh& mesh = scene.garments[garment].mesh;
    return girths(pose_skeleton(rig.skeleton, pose), rig.weights, body, { mesh, mesh.positions });
}

void recover(Scene& scene, const Parameters& p, const Progress& progress)
{
    scene.recovered = moved(scene, *scene.draped, Pose(), p.recover, Stage::recover, progress);
    scene.recovered->certified &= all_put_on(scene);
    judge_hips(scene, *scene.recovered);
}

/// A stage that dresses, whose dressing may be that of stand-ins.
struct DressingStage {
    RunStage* run;
    Stage stage;
    std::optional<Dressing> Scene::*output;
    bool is_on_the_way;  ///< where it ends well, another stage goes on from there
};

/// Whether nothing crosses at the end of the way. Parts of the body that rough cloth holds back may go on in finer cloth.
bool has_arrived(const Dressing& dressing)
{
    return all_clean(dressing.garments) && dressing.scale_reached == 1 && dressing.pose_reached == 1
        && !dressing.out_of_time;
}

/// From where garments followed rough stand-ins, to a rest of their own. As they followed, where that is not clean.
void find_own_rest(const DressingStage& stage, Scene& scene, const Parameters& p, const Progress& progress)
{
    Dressing& led = *(scene.*stage.output);
    RecoverOptions options = p.recover;
    options.settling_steps = k_own_settling_steps;
    options.frames = 0;
    options.only_rests = true;
    if (stage.stage == Stage::drape) {
        options.quality = Quality::draft;
        options.cloth = p.drape.cloth;
        options.cloth.largest_stretch = std::numeric_limits<double>::infinity();  // as the body grew, it was judged
    }
    Dressing own = moved(scene, led, led.pose, options, stage.stage, progress);
    if (outcome_of(own) == Outcome::not_certified)
        return;
    for (WornGarment& garment : own.garments)
        garment.stand_in.reset();
    own.frames = std::move(led.frames);
    own.frames_asked = led.frames_asked;
    if (!own.frames.empty())
        for (const std::size_t i : own.worn())
            own.frames.back().garments[i] = own.garments[i].positions;
    led = std::move(own);
}

/// What comes of it is judged once the garments have found a rest of their own.
Parameters for_rough_cloth(Parameters p)
{
    p.recover.quality = Quality::draft;
    p.recover.cloth.largest_stretch = std::numeric_limits<double>::infinity();
    return p;
}

void run_with_stand_ins(const DressingStage& stage, Scene& scene, const Parameters& p, const Progress& progress);

/// By which a garment has to be larger, with what its fabric may give.
double lacking_factor(double enlargement, double fabric_stretch)
{
    return (1 + enlargement) / given_by_larger(fabric_stretch);
}

/// The same round a part for which it is too small.
double lacking_factor(const Dressing& end, const TooTight& part)
{
    return lacking_factor(part.enlargement, end.fabric_stretches[std::size_t(part.garment)]);
}

/// Parts at which the body, in the pose of the fit, is far wider than a garment can give.
Widening lacking_girths(const Scene& scene, std::size_t garment, double fabric_stretch, double most)
{
    Widening result;
    for (const Girth& girth : girths_in_fit(scene, garment))
        if (girth.body > (1 + fabric_stretch) * k_far_too_narrow * girth.garment)
            widen_both_sides(result, girth.place,
                             std::min(1 + most, lacking_factor(girth.body / girth.garment - 1, fabric_stretch)));
    return result;
}

void widen(Scene& scene, std::size_t garment, const Widening& widening)
{
    GarmentInput& input = scene.garments[garment];
    GarmentMesh wider = widen_garment(*scene.rig, *scene.body, scene.fits[garment].pose, input.mesh, widening);
    if (!input.as_given)
        input.as_given = std::move(input.mesh);
    input.mesh = std::move(wider);
    input.stand_in.reset();
    for (const auto& [part, factor] : widening)
        input.widening[part] = factor * factor_of(input.widening, part);
}

/// Stand-ins that may be led by rough ones in turn.
std::optional<Dressing> run_leaders(const DressingStage& stage, const Scene& led, const Parameters& p,
                                    const Progress& progress)
{
    DressingStage whole = stage;
    whole.is_on_the_way = false;
    Scene leaders = with_stand_ins_to_be_found(led);
    run_with_stand_ins(whole, leaders, p, progress);
    Scene as_they_are = leaders;
    if (!progress.is_late() && give_up_stand_ins(as_they_are))
        run_with_stand_ins(whole, leaders = std::move(as_they_are), p, progress.part(1, 1));
    return std::move(leaders.*stage.output);
}

struct Followed {
    Dressing dressing;
    bool led_well;
};

/// Leads the stand-ins through a stage, and the garments after them.
Followed lead_and_follow(const DressingStage& stage, const Scene& scene, const Parameters& p, const Progress& progress)
{
    Scene led = lead(scene);
    if (is_led_roughly(scene))
        stage.run(led, for_rough_cloth(p), progress.part(0, k_progress_of_leading));
    else
        led.*stage.output = run_leaders(stage, led, p, progress);
    const std::vector<std::size_t> order = worn_from_inside_out(scene, *(led.*stage.output));
    const bool led_well = (led.*stage.output)->certified;
    const ClothOptions& cloth = stage.stage == Stage::drape ? p.drape.cloth : p.recover.cloth;
    return { follow_stand_ins({ scene, led, order, stage.is_on_the_way && led_well }, *std::move(led.*stage.output),
                              cloth, progress),
             led_well };
}

/// Once more as draft quality has it, if that is certified: where stand-ins lie at rest, garments may not be able to
/// follow without crossing, though they are where these only hang.
void follow_before_rest(const DressingStage& stage, const Scene& scene, Parameters p, Followed& followed,
                        const Progress& progress)
{
    p.recover.quality = Quality::draft;
    if (Followed earlier = lead_and_follow(stage, scene, p, progress); earlier.dressing.certified)
        followed = std::move(earlier);
}

/// Runs a stage with stand-ins in the places of garments that need one, or are dressed faster with one.
void run_with_stand_ins(const DressingStage& stage, Scene& scene, const Parameters& p, const Progress& progress)
{
    if (!find_stand_ins(scene))
        return stage.run(scene, p, progress);
    const bool is_rough = is_led_roughly(scene),
               finds_rest = stage.stage == Stage::recover && !is_rough && p.recover.quality != Quality::draft;
    Followed followed = lead_and_follow(stage, scene, p, progress);
    const auto has_failed = [&] { return followed.led_well && !followed.dressing.certified; };
    if (finds_rest && has_failed() && !progress.is_late())
        follow_before_rest(stage, scene, p, followed, progress.part(1, 1));
    if (has_failed() && progress.is_late())
        followed.dressing.out_of_time = stage.stage;
    scene.*stage.output = std::move(followed.dressing);
    if (is_rough && !stage.is_on_the_way && has_arrived(*(scene.*stage.output)))
        find_own_rest(stage, scene, p, progress.part(k_progress_of_leading, 1));
}

}  // namespace

void judge_hips(const Scene& scene, Dressing& dressing)
{
    for (std::size_t i = 0; i < dressing.below_hips.size(); ++i) {
        if (!dressing.certified || dressing.below_hips[i].empty())
            continue;
        for (const Girth& girth : girths_in_fit(scene, i))
            if (girth.place == "hips" && girth.ease() < 0)
                dressing.too_tight.push_back(
                    { int(i), girth.place, -girth.ease(),
                      girth.body / girth.garment * given_by_larger(dressing.fabric_stretches[i]) - 1 });
        dressing.certified = dressing.too_tight.empty();
    }
}

void take_as_given(GarmentInput& garment)
{
    if (std::exchange(garment.fabric_is_guessed, false))
        garment.fabric.reset();
    if (!garment.as_given)
        return;
    garment.mesh = std::move(*garment.as_given);
    garment.as_given.reset();
    garment.stand_in.reset();
    garment.widening.clear();
    garment.share = 1;
}

void take_size(GarmentInput& garment, double share)
{
    take_as_given(garment);
    garment.as_given = garment.mesh;
    garment.share = share;
    garment.mesh.positions *= share;
    garment.stand_in.reset();
    garment.skipped = 0;
}

bool take_size_in_unit(Scene& scene)
{
    bool any = false;
    for (GarmentInput& garment : scene.garments)
        if (garment.size_in_unit > 1) {
            take_size(garment, garment.size_in_unit);
            any = true;
        }
    return any;
}

bool widen_too_small(Scene& scene, double most, double share)
{
    const Dressing* end = final_dressing(scene);
    if (!end || outcome_of(*end) != Outcome::too_small || end->too_tight.empty())
        return false;
    std::vector<Widening> widenings(scene.garments.size());
    for (const TooTight& part : end->too_tight) {
        const double factor = std::pow(std::max(1.0, lacking_factor(*end, part)), share);
        widen_both_sides(widenings[std::size_t(part.garment)], part.part, factor);
    }
    for (std::size_t i = 0; i < widenings.size(); ++i)
        for (const auto& [part, factor] : widenings[i])
            if (factor_of(scene.garments[i].widening, part) * factor > 1 + most)
                return false;
    for (std::size_t i = 0; i < widenings.size(); ++i)
        if (largest_factor(widenings[i]) > 1)
            widen(scene, i, widenings[i]);
    return true;
}

bool widen_far_too_narrow(Scene& scene, const Parameters& parameters, double most)
{
    const ClothOptions& cloth = parameters.drape.cloth;
    bool any = false;
    for (std::size_t i = 0; i < scene.garments.size(); ++i) {
        const Fabric fabric = scene.garments[i].fabric.value_or(cloth.fabric);
        const Widening lacking = lacking_girths(scene, i, material_of(cloth, fabric).largest_stretch, most);
        if (lacking.empty())
            continue;
        widen(scene, i, lacking);
        any = true;
    }
    return any;
}

bool enlarge_too_small(Scene& scene, const Parameters& parameters)
{
    const Dressing* end = final_dressing(scene);
    if (!end || outcome_of(*end) != Outcome::too_small || end->scale_reached < 1)
        return false;
    std::vector<double> sizes;
    for (const WornGarment& garment : end->garments)
        sizes.push_back(garment.size);
    for (const TooTight& part : end->too_tight) {
        const auto i = std::size_t(part.garment);
        sizes[i] = std::max(sizes[i], end->garments[i].size * lacking_factor(*end, part));
    }
    for (std::size_t i = 0; i < sizes.size(); ++i)
        if (sizes[i] > 1 + options_for(scene.garments[i], parameters.drape).cloth.largest_enlargement)
            return false;
    for (std::size_t i = 0; i < sizes.size(); ++i)
        scene.garments[i].size = sizes[i];
    return true;
}

bool may_be_worn_in_the_end(const Scene& scene)
{
    const Dressing* end = final_dressing(scene);
    if (!end || outcome_of(*end) == Outcome::done || is_held_where_body_crosses_itself(*end))
        return false;
    return std::none_of(end->too_tight.begin(), end->too_tight.end(), [&](const TooTight& part) {
        return part.enlargement > k_hopelessly_small * end->fabric_stretches[std::size_t(part.garment)];
    });
}

void take_usual_knits(Scene& scene, const Parameters& parameters)
{
    const ClothOptions& cloth = parameters.recover.cloth;
    const Dressing* end = final_dressing(scene);
    if (!end || cloth.fabric != ClothOptions().fabric || has_own_figures(cloth))
        return;
    for (std::size_t i = 0; i < scene.fits.size(); ++i) {
        GarmentInput& garment = scene.garments[i];
        if (garment.fabric || !is_too_small(*end, i))
            continue;
        garment.fabric = usual_knit(scene.fits[i].type);
        garment.fabric_is_guessed = garment.fabric.has_value();
    }
}

bool is_knit_stretched_all_over(const Scene& scene)
{
    const Dressing& end = *final_dressing(scene);
    const double cotton = material_of(ClothOptions()).largest_stretch;
    for (std::size_t i = 0; i < end.loads.size(); ++i) {
        const auto stretched = std::count_if(end.loads[i].begin(), end.loads[i].end(),
                                             [&](const PartLoad& load) { return load.stretch > cotton; });
        if (scene.garments[i].fabric_is_guessed && 2 * stretched > std::ptrdiff_t(end.loads[i].size()))
            return true;
    }
    return false;
}

Parameters putting_on_softly(Parameters parameters)
{
    const Material soft = material_of(k_put_on_as);
    ClothOptions& cloth = parameters.drape.cloth;
    cloth.stretch_stiffness = soft.stretch_stiffness;
    cloth.weft_to_warp = soft.weft_to_warp;
    cloth.shear_stiffness = soft.shear_stiffness;
    cloth.bend_stiffness = soft.bend_stiffness;
    cloth.largest_stretch = soft.largest_stretch;
    return parameters;
}

bool is_caught(const Scene& scene)
{
    const Dressing* end = final_dressing(scene);
    if (!end || outcome_of(*end) == Outcome::done || is_held_where_body_crosses_itself(*end))
        return false;
    return first_garment(*end, is_torn) || is_held_back(*end);
}

Parameters growing_slowly(Parameters parameters)
{
    parameters.drape.growing_steps *= k_slower;
    return parameters;
}

Parameters moving_slowly(Parameters parameters)
{
    parameters.recover.largest_steps *= k_slower;
    parameters.recover.step_length /= k_slower;
    return parameters;
}

bool loosen(Scene& scene, double size)
{
    const Dressing* end = final_dressing(scene);
    if (!end || !is_held_back(*end))
        return false;
    bool any = false;
    for (GarmentInput& garment : scene.garments)
        if (!garment.has_unit && garment.size < size) {
            garment.size = size;
            any = true;
        }
    return any;
}

void drape_stage(Scene& scene, const Parameters& p, const Progress& progress)
{
    run_with_stand_ins({ drape_all, Stage::drape, &Scene::draped, false }, scene, p, progress);
}

void drape_on_the_way_stage(Scene& scene, const Parameters& p, const Progress& progress)
{
    run_with_stand_ins({ drape_all, Stage::drape, &Scene::draped, true }, scene, p, progress);
}

void recover_stage(Scene& scene, const Parameters& p, const Progress& progress)
{
    run_with_stand_ins({ recover, Stage::recover, &Scene::recovered, false }, scene, p, progress);
}

}  // namespace garmentfit
