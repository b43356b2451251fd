// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/drape_garment.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "cloth_motion.h"
#include "coarse_body.h"
#include "garmentfit/closed_ends.h"
#include "garmentfit/fit_skeleton.h"
#include "growing_body.h"
#include "held_back.h"
#include "layers.h"
#include "prepared_cloth.h"
#include "rest_on_body.h"
#include "sewn_body.h"
#include "skin_weights.h"
#include "sleeve_retraction.h"
#include "tightness.h"
#include "tuning.h"
#include "untangle.h"

namespace garmentfit {
namespace {

// ---- the start -----------------------------------------------------------------------------------------------------

/// What draping begins with, prepared once.
struct DrapeStart {
    PreparedCloth cloth;
    GrowingBody inside;
    double scale;  ///< of what is inside
};

/// The cloth with retracted sleeves, untangled. None where pairs cross then that did not cross as given: cloth in
/// narrow folds may cross, because triangles stay flat, and mostly comes apart.
std::optional<PreparedCloth> retract_sleeves(const SleeveRetraction& retraction, const PreparedCloth& given)
{
    const Triangles& triangles = given.rest.triangles;
    UntangleResult retracted = untangle({ retraction.positions(), triangles }, given.topology.edges());
    if (!retracted.left.empty())
        if (const std::vector<Crossing> crossed = self_crossings({ given.rest.positions, triangles });
            !std::includes(crossed.begin(), crossed.end(), retracted.left.begin(), retracted.left.end()))
            return {};
    PreparedCloth result = given;
    result.positions = std::move(retracted.positions);
    result.crossings = std::move(retracted.left);
    return result;
}

DrapeStart make_start(PreparedCloth cloth, GrowingBody inside, double scale)
{
    untangle_clear_of(cloth, { inside.at(scale), inside.full.triangles });
    return { std::move(cloth), std::move(inside), scale };
}

/// Sleeves and legs are retracted where that leaves the body free of the cloth, else they stay as given. None where
/// cloth and bones cross.
std::optional<DrapeStart> find_start(const Wearer& wearer, const GarmentMesh& garment)
{
    const PreparedCloth given = prepare_cloth(garment, garment.positions);
    if (const SleeveRetraction retraction(wearer.joints, { given.positions, given.rest.triangles }, given.sewn.ties);
        retraction.is_any())
        if (const auto retracted = retract_sleeves(retraction, given)) {
            const TriangleMesh cloth { given.weld.place(retracted->positions), garment.triangles };
            GrowingBody inside = make_growing_body(wearer, { cloth.positions, cloth.triangles }, &retraction);
            if (const auto scale = find_initial_scale(inside, cloth))
                return make_start(*retracted, std::move(inside), *scale);
        }
    GrowingBody inside = make_growing_body(wearer, garment, nullptr);
    const TriangleMesh cloth { garment.positions, garment.triangles };
    if (const auto scale = find_initial_scale(inside, cloth))
        return make_start(given, std::move(inside), *scale);
    return {};
}

/// As near as can be to where the pose has a bare body: bones that are fitted to the outside of thick cloth may pass
/// through a collar's or a hem's inner sheet, by millimetres.
/// @param bare  the wearer's; ends where the start is
/// @throws InvalidInput where cloth and bones cross there, too
DrapeStart choose_start(Wearer& wearer, DressedBody& bare, const GarmentMesh& garment)
{
    if (auto start = find_start(wearer, garment))
        return *std::move(start);
    const Pose pose = bare.pose;
    if (bare.garments.empty() && bare.body.rows() == 0)
        for (int i = 1; i <= k_start_shifts; ++i)
            for (const Vec3 way : { Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ() })
                for (const double sign : { 1, -1 }) {
                    bare.pose.root_translation = pose.root_translation + sign * i * k_start_shift * way;
                    wearer.joints = pose_skeleton(wearer.rig.skeleton, bare.pose);
                    if (auto start = find_start(wearer, garment))
                        return *std::move(start);
                }
    bare.pose = pose;
    wearer.joints = pose_skeleton(wearer.rig.skeleton, pose);
    refuse(make_growing_body(wearer, garment, nullptr), { garment.positions, garment.triangles }, wearer.rig.weights);
}

// ---- growing the body ----------------------------------------------------------------------------------------------

/// Makes a garment larger while the body grows in it, all of it alike.
class Grading {
public:
    /// @param tightness  of the garment as given
    Grading(const GarmentMesh& given, Tightness tightness, const ClothOptions& cloth) :
        given_(given), tightness_(std::move(tightness)), largest_enlargement_(cloth.largest_enlargement)
    {
    }

    void enlarge(ClothMotion& motion, double size)
    {
        size_ = size;
        motion.set_rest(garment());
        tightness_.set_rest(garment().positions);
    }

    bool is_tight(const ClothMotion& motion) const { return tightness_.needed_size(motion.cloth(), 1) > 1; }

    /// Enlarges the garment where the body stretches it too far. @return false if that takes more than is allowed
    bool enlarge_if_tight(ClothMotion& motion)
    {
        if (!is_tight(motion))
            return true;
        const double larger = size_ * tightness_.needed_size(motion.cloth(), k_enlarged_stretch_share);
        if (larger > 1 + largest_enlargement_)
            return false;
        enlarge(motion, larger);
        return true;
    }

    const Tightness& tightness() const { return tightness_; }
    double size() const { return size_; }
    GarmentMesh garment() const { return { size_ * given_.positions, given_.triangles, given_.warps }; }

private:
    const GarmentMesh& given_;
    Tightness tightness_;
    double largest_enlargement_;
    double size_ = 1;
};

/// Lets tight cloth slide to where it is wide enough, if it does.
void relax_if_tight(ClothMotion& motion, const MotionStep& step, const Grading& grading)
{
    if (!grading.is_tight(motion))
        return;
    const Positions before = motion.state();
    for (int k = 0; k < k_relaxing_steps && grading.is_tight(motion); ++k)
        motion.advance(step);
    if (grading.is_tight(motion))
        motion.restore(before);  // what it lacks is told from where it went first
}

/// Where the garment is too small for a body that grows on.
std::vector<TooTight> list_tight_parts(const ClothMotion& motion, const GrowingBody& inside, const Tightness& tightness,
                                       const Wearer& wearer)
{
    const PerPart growth = growth_left(motion.cloth(), inside.body_of(motion.obstacle()),
                                       inside.body_of(inside.full.positions), wearer.rig.weights, wearer.joints);
    return tightness.list_tight_parts(motion.cloth(), k_named_stretch_share, growth);
}

struct Growth {
    double scale;  ///< 1, or less where the cloth would stretch too far, or the deadline passed
    bool out_of_time;
    std::vector<TooTight> too_tight = {};  ///< where that ends the growth
};

/// Lets the body grow inside the garment.
Growth grow_body(ClothMotion& motion, const DrapeStart& start, Grading& grading, int steps, const Wearer& wearer,
                 const Progress& progress)
{
    constexpr double k_just_below = 1 - 1e-3;  // unit: the last step ends at 1, which would say that the garment fits
    const GrowingBody& inside = start.inside;
    MotionStep step;
    step.largest_move = step.largest_obstacle_move = k_growing_move;
    double reached = start.scale;
    for (int i = 1; i <= steps; ++i) {
        if (!progress.goes_on(double(i) / steps))
            return { reached, true };
        const double scale = start.scale + (1 - start.scale) * i / steps;
        const Positions target = inside.at(scale);
        step.obstacle_target = &target;
        motion.advance(step);
        if (i == steps)  // below full size it has more of the way before it
            relax_if_tight(motion, step, grading);
        if (!grading.enlarge_if_tight(motion))
            if (auto too_tight = list_tight_parts(motion, inside, grading.tightness(), wearer); !too_tight.empty())
                return { i < steps ? scale : k_just_below, false, std::move(too_tight) };
        reached = scale;
    }
    const Positions bridged = inside.at(1);
    step.obstacle_target = &bridged;
    step_until_converged(motion, step, progress);
    motion.advect_obstacle(inside.withdrawn);
    motion.advect_obstacle(inside.full.positions);
    return { 1, false };
}

/// How the new garment is made.
struct Make {
    PieceCounts pieces;
    int closed_ends;
    LeftOut left_out;
};

/// Writes body and garments at the end of the motion, and certifies them.
void write_dressed_body(DrapeResult& result, const ClothMotion& motion, const GrowingBody& inside,
                        const Grading& grading, const Make& make, const Wearer& wearer)
{
    const Positions reached = motion.obstacle();
    std::vector<WornGarment> outermost { { .rest = grading.garment(),
                                           .positions = motion.cloth(),
                                           .size = grading.size(),
                                           .pieces = make.pieces,
                                           .closed_ends = make.closed_ends,
                                           .left_out = make.left_out } };
    add_slips(outermost, outermost[0].rest.positions);
    static_cast<DressedBody&>(result) = wearer.dressed;
    result.body = inside.body_of(reached);
    set_positions(result.garments, reached.bottomRows(reached.rows() - inside.body_vertices));
    result.garments.push_back(outermost[0]);
    measure_piece_shifts(result.garments);
    const bool clean = certify_all(result.garments, { result.body, wearer.body.surface.triangles });
    result.certified = clean && reached == inside.full.positions;
    if (!clean && result.scale_reached < 1 && !wearer.dressed.garments.empty()) {
        // body and inner garments need not keep clear of each other below full size: they are returned as they were
        static_cast<DressedBody&>(result) = wearer.dressed;
        if (result.body.rows() == 0)
            result.body = inside.body_of(inside.full.positions);
    }
}

DrapeResult drape_on(const Rig& rig, const BodyMesh& body, const DressedBody& dressed, const GarmentMesh& given,
                     const DrapeOptions& options, const Progress& progress)
{
    require_wearable_size(rig, given);
    const OpenedGarment opened = open_ends(given);
    const GarmentMesh& garment = opened.garment;
    DressedBody before = dressed;
    Wearer wearer { rig, body, before, HandStretch(rig, body.surface.positions),
                    pose_skeleton(rig.skeleton, dressed.pose) };
    DrapeStart start = choose_start(wearer, before, garment);
    const GrowingBody& inside = start.inside;

    const Edges edges = edges_of(garment.triangles);
    const SkinWeights weights
        = weights_of_nearest(garment.positions, inside.body_of(inside.full.positions), rig.weights);
    const double allowed = material_of(options.cloth).largest_stretch;
    Grading grading(garment,
                    Tightness(garment.positions, edges, weights, wearer.joints, allowed, int(dressed.garments.size())),
                    options.cloth);
    const PieceCounts pieces = start.cloth.sewn.counts;
    ClothMotion motion(std::move(start.cloth),
                       { { inside.at(start.scale), inside.full.triangles }, int(inside.body_vertices) }, options.cloth);

    if (options.size > 1)
        grading.enlarge(motion, options.size);

    DrapeResult result;
    Growth growth = grow_body(motion, start, grading, options.growing_steps, wearer, progress.part(0, 0.7));
    result.scale_reached = growth.scale;
    result.out_of_time = growth.out_of_time;
    if (result.scale_reached == 1) {
        const SettleResult settled
            = settle(motion, inside.full.positions, options.settling_steps, progress.part(0.7, 1));
        result.speed = settled.speed;
        result.out_of_time = settled.out_of_time;
    } else {
        result.too_tight = std::move(growth.too_tight);
        motion.advect_obstacle(inside.shrink(inside.withdrawn, growth.scale));  // no bridges on what is handed out
        motion.advect_obstacle(inside.shrink(inside.full.positions, growth.scale));
    }
    result.seconds = motion.seconds();
    write_dressed_body(result, motion, inside, grading, { pieces, opened.closed_ends, opened.left_out }, wearer);
    if (result.scale_reached == 1)
        result.held_back = list_held_back_parts(result.body, inside.body_of(inside.full.positions), rig.weights);
    return result;
}

/// Lets the body go from where it is laid to its own skin, and the garments hang there.
void hang_on_own_skin(DrapeResult& result, const Rig& rig, const BodyMesh& body, const DrapeOptions& options,
                      const Progress& progress)
{
    RecoverOptions hanging { .cloth = options.cloth, .quality = Quality::draft };
    hanging.cloth.largest_stretch = std::numeric_limits<double>::infinity();  // as the body grew, it was judged
    const RecoverResult hung = rest_on_body(rig, body, result, hanging, progress);
    static_cast<DressedBody&>(result) = hung;
    result.held_back = hung.held_back;
    result.speed = hung.speed;
    result.certified = hung.certified;
    result.out_of_time = hung.out_of_time;
    result.seconds += hung.seconds;
}

}  // namespace

Material material_of(const ClothOptions& options, const WornGarment& worn)
{
    return material_of(options, worn.fabric.value_or(options.fabric));
}

bool all_clean(const std::vector<WornGarment>& garments)
{
    return std::all_of(garments.begin(), garments.end(),
                       [](const WornGarment& garment) { return garment.certificate.clean(); });
}

bool certify_all(std::vector<WornGarment>& garments, const TriangleMesh& body)
{
    std::vector<TriangleMesh> under;
    for (WornGarment& garment : garments) {
        garment.certificate = certify(body, garment.rest, garment.positions, under);
        under.push_back({ garment.positions, garment.rest.triangles });
    }
    return all_clean(garments);
}

DrapeResult drape_garment(const Rig& rig, const BodyMesh& body, const DressedBody& dressed, const GarmentMesh& given,
                          const DrapeOptions& options, const Progress& progress)
{
    const auto drape = [&](const Rig& on, const BodyMesh& skin, const DressedBody& worn, const Progress& part) {
        return drape_on(on, skin, worn, given, options, part);
    };
    return move_sewn(rig, body, dressed, progress,
                     [&](const Rig& on, const BodyMesh& skin, const DressedBody& worn, const Progress& part) {
                         return move_coarse(on, skin, worn, part, drape,
                                            [&](DrapeResult& result, bool has_own_skin, const Progress& rest) {
                                                if (!has_own_skin)
                                                    hang_on_own_skin(result, on, skin, options, rest);
                                            });
                     });
}

}  // namespace garmentfit
