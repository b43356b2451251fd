// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/recover_pose.h"

#include <algorithm>
#include <cmath>

#include "append_mesh.h"
#include "body_parts.h"
#include "cloth_motion.h"
#include "coarse_body.h"
#include "creases.h"
#include "garmentfit/error.h"
#include "held_back.h"
#include "layers.h"
#include "overlaps.h"
#include "pose_path.h"
#include "pressed_skin.h"
#include "rest_on_body.h"
#include "sewn_body.h"
#include "skin_weights.h"
#include "stretch.h"
#include "tightness.h"
#include "topology.h"
#include "tuning.h"

namespace garmentfit {
namespace {

// ---- before anything moves -----------------------------------------------------------------------------------------

/// World-from-rest transform of the root.
Eigen::Isometry3d root_transform(const Rig& rig, const Pose& pose)
{
    const Vec3& root = rig.skeleton.root;
    return Eigen::Translation3d(root + pose.root_translation) * pose.root_rotation * Eigen::Translation3d(-root);
}

void apply(const Eigen::Isometry3d& transform, Positions& positions)
{
    positions = (positions * transform.linear().transpose()).rowwise() + transform.translation().transpose();
}

void apply(const Eigen::Isometry3d& transform, Positions& body, std::vector<WornGarment>& garments)
{
    apply(transform, body);
    for (WornGarment& garment : garments)
        apply(transform, garment.positions);
}

/// Carries body and cloth as one to where the target has the root: no cloth has to be moved for that, and what is left
/// of the path is how the body bends.
DressedBody carry_to_root(const Rig& rig, DressedBody dressed, const Pose& target)
{
    if (dressed.pose.root_translation == target.root_translation
        && dressed.pose.root_rotation.coeffs() == target.root_rotation.coeffs())
        return dressed;
    const Eigen::Isometry3d carry = root_transform(rig, target) * root_transform(rig, dressed.pose).inverse();
    dressed.pose.root_translation = target.root_translation;
    dressed.pose.root_rotation = target.root_rotation;
    apply(carry, dressed.body, dressed.garments);
    return dressed;
}

/// All garments as one mesh.
struct Outfit {
    GarmentMesh rest;
    TriangleMesh cloth;
    std::vector<int> garment_of;  // by vertex
    std::vector<Fabric> fabrics;

    Outfit(const std::vector<WornGarment>& garments, Fabric otherwise)
    {
        for (int i = 0; i < int(garments.size()); ++i) {
            append(rest, garments[i].rest);
            append(cloth, { garments[i].positions, garments[i].rest.triangles });
            garment_of.resize(std::size_t(cloth.positions.rows()), i);
            fabrics.push_back(garments[i].fabric.value_or(otherwise));
        }
    }
};

void require_no_crossings(const TriangleMesh& cloth, const TriangleMesh& body)
{
    if (const int crossing = crossing_count(cloth, body); crossing > 0)
        throw InvalidInput(ErrorCode::crossing_start,
                           "garment and body cross at " + std::to_string(crossing)
                               + " places at the start; drape the garment first");
}

/// Skin weights that change slowly over the cloth, so that what lies between two limbs follows both.
SkinWeights smooth_weights(const SkinWeights& weights, const Triangles& triangles)
{
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(weights.bones.rows(), bone_count);
    for (Eigen::Index v = 0; v < dense.rows(); ++v)
        for (int k = 0; k < 4; ++k)
            dense(v, weights.bones(v, k)) += weights.weights(v, k);
    const Edges edges = edges_of(triangles);
    const Eigen::ArrayXd shares = 1 + edge_counts(edges, dense.rows()).array();
    for (int pass = 0; pass < k_weight_smoothing_passes; ++pass) {
        Eigen::MatrixXd sum = dense;
        add_neighbours(edges, dense, sum);
        dense = sum.array().colwise() / shares;
    }
    return strongest_four(dense);
}

// ---- the motion ----------------------------------------------------------------------------------------------------

/// Keeps states along the path, evenly spread, with the root where the path has it.
class FrameRecorder {
public:
    /// @param dressed  before it was carried to the target's root; the path begins there. Kept as a reference
    FrameRecorder(const Rig& rig, const DressedBody& dressed, const Pose& target, const Triangles& body, int frames) :
        rig_(rig), dressed_(dressed), target_(target), garments_(dressed.garments), body_(body), frames_(frames)
    {
    }

    /// Keeps the start of the path as it was given.
    void record_start(const Positions& body)
    {
        if (is_due(0))
            keep(0, body);
    }

    void record(const ClothMotion& motion, double share)
    {
        if (!is_due(share))
            return;
        Positions body = motion.obstacle();
        set_positions(garments_, motion.cloth());
        if (share < 1) {
            const Eigen::Isometry3d carry
                = root_transform(rig_, slerp(dressed_.pose, target_, share)) * root_transform(rig_, target_).inverse();
            apply(carry, body, garments_);
        }
        keep(share, body);
    }

    std::vector<RecoverFrame> take() && { return std::move(kept_); }

private:
    bool is_due(double share)
    {
        constexpr double k_rounding = 1e-9;  // unit: shares are quotients of step counts
        const double next = frames_ == 1 ? 1 : double(due_) / (frames_ - 1);
        const bool due = frames_ > 0 && share >= next - k_rounding;
        due_ += due;
        return due;
    }

    /// Only if it is certified.
    void keep(double share, const Positions& body)
    {
        if (!certify_all(garments_, { body, body_ }))
            return;
        kept_.push_back({ share, body, {} });
        for (const WornGarment& garment : garments_)
            kept_.back().garments.push_back(garment.positions);
    }

    const Rig& rig_;
    const DressedBody& dressed_;
    const Pose& target_;
    std::vector<WornGarment> garments_;
    const Triangles& body_;
    int frames_, due_ = 0;
    std::vector<RecoverFrame> kept_;
};

/// Skin weights of what moves.
struct MovedWeights {
    const SkinWeights& body;
    SkinWeights cloth;
};

struct PathOutcome {
    double share = 0;  ///< of the path that was gone: 1, or less where the body got stuck
    double in_place = 0;  ///< the last share at which the whole body was in its place
    Positions state_in_place {};  ///< of the motion, there
    bool out_of_time = false;  ///< the deadline passed before the end of the path

    bool ended_early() const { return share < 1 || out_of_time; }
    double reached() const { return ended_early() ? in_place : 1; }
};

MotionStep moving_step(const Positions& target)
{
    MotionStep step;
    step.obstacle_target = &target;
    step.gravity = k_gravity;
    step.friction_fraction = k_moving_friction;
    return step;
}

/// Advects body and cloth by the body's skinning from one share of the path to the next, then lets the cloth find its
/// rest.
/// @return m; the longest distance of a vertex of the body from its place
double step_along(ClothMotion& motion, const PosePath& path, double from, double to, const MovedWeights& weights,
                  double stuck_lag, const Progress& progress)
{
    const BoneTransforms transforms = relative_transforms(path.transforms(from), path.transforms(to));
    const Positions cloth = motion.cloth(), body = motion.obstacle(), target = path.bridged_at(to);
    motion.advect(skin(cloth, weights.cloth, transforms) - cloth, skin(body, weights.body, transforms) - body);
    const MotionStep step = moving_step(target);
    const double lag = motion.advance(step);
    return lag > stuck_lag ? step_until_converged(motion, step, progress) : lag;  // it may only be slow
}

/// Moves body and cloth along the path. Ends early where cloth holds a part of the body back too far, and when the
/// deadline passes.
PathOutcome follow_path(ClothMotion& motion, const PosePath& path, const MovedWeights& weights,
                        const RecoverOptions& options, FrameRecorder& recorder, const Progress& progress)
{
    const double length = path.length(motion.cloth(), weights.cloth);
    const int needed = std::clamp(int(std::ceil(length / options.step_length)), 1, options.largest_steps);
    const int steps = std::max(needed, options.frames - 1);  // a frame is where a step ends
    const double stuck_lag = k_stuck_lag + (motion.obstacle() - path.at(0)).rowwise().norm().maxCoeff();
    PathOutcome outcome { 0, 0, motion.state() };
    for (int i = 1; i <= steps; ++i) {
        outcome.out_of_time = !progress.goes_on(double(i) / steps);
        if (outcome.out_of_time)
            return outcome;
        outcome.share = double(i) / steps;
        const double lag = step_along(motion, path, double(i - 1) / steps, outcome.share, weights, stuck_lag, progress);
        if (lag < k_in_place) {
            outcome.in_place = outcome.share;
            outcome.state_in_place = motion.state();
        }
        if (lag > stuck_lag)
            return outcome;
        if (i < steps)
            recorder.record(motion, outcome.share);
    }
    const Positions bridged = path.bridged_at(1);
    step_until_converged(motion, moving_step(bridged), progress);
    return outcome;
}

// ---- what came of it -----------------------------------------------------------------------------------------------

/// Lists where garments are too small for a pose, though they were big enough for the one before. Where a garment was
/// wider than the body before by more than it may be stretched, it is caught, not too small.
std::vector<TooTight> list_tight_parts(const Rig& rig, const DressedBody& before, const DressedBody& now,
                                       const ClothOptions& cloth)
{
    const Skeleton joints_before = pose_skeleton(rig.skeleton, before.pose),
                   joints = pose_skeleton(rig.skeleton, now.pose);
    std::vector<TooTight> result;
    for (std::size_t i = 0; i < now.garments.size(); ++i) {
        const WornGarment& garment = now.garments[i];
        const Edges edges = edges_of(garment.rest.triangles);
        const double allowed = material_of(cloth, garment).largest_stretch;
        const Tightness tightness(garment.rest.positions, edges,
                                  weights_of_nearest(garment.positions, now.body, rig.weights), joints, allowed,
                                  int(i));
        const std::vector<TooTight> tight = tightness.list_tight_parts_at_rest(garment.positions);
        if (tight.empty())
            continue;
        const PerPart wider = slack(before.garments[i].positions, before.body, rig.weights, joints_before);
        for (const TooTight& part : tight)
            for (int p = 0; p < k_body_parts; ++p)
                if (part.part == part_name(p) && wider[p] <= allowed)
                    result.push_back(part);
    }
    return result;
}

/// Whether a garment is stretched so far that it will not slide to where it is wide enough.
bool is_far_too_tight(const DressedBody& now, const ClothOptions& cloth)
{
    return std::any_of(now.garments.begin(), now.garments.end(), [&](const WornGarment& garment) {
        const auto edges = edge_stretches(garment.rest.positions, garment.positions, edges_of(garment.rest.triangles));
        return quantile_by_length(edges, k_stretch_quantile)
            > k_far_too_tight * material_of(cloth, garment).largest_stretch;
    });
}

struct Start {
    const Rig& rig;
    const DressedBody& dressed;
    const Triangles& skin;  ///< of the body
};

/// Lets the cloth hang at the end of the way, leads it to rest where that is asked for, and writes what comes of it.
/// What looks too small is led there as well, for it may slide to where it is not, unless it is far too small.
/// @return whether the whole body is in its place, or pressed in by no more than it may be
bool come_to_rest(ClothMotion& motion, const Positions& end, Quality quality, const RecoverOptions& options,
                  const Start& start, RecoverResult& result, const Progress& progress)
{
    const auto write = [&] {
        result.body = motion.obstacle();
        set_positions(result.garments, motion.cloth());
        result.too_tight = list_tight_parts(start.rig, start.dressed, result, options.cloth);
    };
    const auto hang = [&](int steps) {
        const SettleResult settled = settle(motion, end, steps, progress.part(0, k_progress_of_settling));
        write();
        return settled;
    };
    SettleResult settled = hang(options.settling_steps);
    const bool looks_too_tight = !result.too_tight.empty(),
               is_hopeless = looks_too_tight && is_far_too_tight(result, options.cloth);
    if (looks_too_tight && !is_hopeless && !settled.out_of_time)  // it may only be caught
        settled = hang(k_steps_if_tight);
    result.speed = settled.speed;
    result.out_of_time = settled.out_of_time;
    const bool is_pressed = settled.lag > 0 && settled.lag + options.cloth.contact_distance <= options.press,
               is_in_place = settled.lag == 0 || is_pressed;
    if (is_pressed) {
        motion.advect_obstacle(give_way(motion.obstacle(), end, start.skin, options.cloth.contact_distance));
        write();
    }
    if (settled.out_of_time)
        return is_in_place;
    if (quality == Quality::draft || is_hopeless || !is_in_place) {
        result.residual = motion.residual();
        return is_in_place;
    }
    const RestResult rest = motion.find_rest(options.settle_time, progress.part(k_progress_of_settling, 1));
    result.residual = rest.residual;
    result.out_of_time = rest.out_of_time;
    write();
    return true;
}

/// Body and garments where the path begins.
struct Departure {
    const DressedBody& given;
    DressedBody carried;  ///< to where the target has the root
    Outfit outfit;
};

/// The way to the target and the rest at its end, with bridges of one kind.
RecoverResult recover_over(BridgeEnds ends, const Rig& rig, const BodyMesh& body, const Departure& departure,
                           const Pose& target, const RecoverOptions& options, const Progress& progress)
{
    DressedBody start = departure.carried;
    const Outfit& outfit = departure.outfit;
    const PosePath path(rig, body, start.pose, target, start.body, outfit.cloth.positions, ends);
    if (start.body.rows() == 0)
        start.body = path.at(0);
    require_no_crossings(outfit.cloth, { start.body, body.surface.triangles });

    const MovedWeights weights { rig.weights,
                                 smooth_weights(weights_of_nearest(outfit.cloth.positions, start.body, rig.weights),
                                                outfit.cloth.triangles) };
    ClothMotion motion(outfit.rest, outfit.cloth.positions, { start.body, body.surface.triangles }, options.cloth,
                       outfit.garment_of, outfit.fabrics);
    FrameRecorder recorder(rig, departure.given, target, body.surface.triangles, options.frames);
    recorder.record_start(departure.given.body.rows() > 0 ? departure.given.body
                                                          : skin(body.surface.positions, rig.weights,
                                                                 bone_transforms(rig.skeleton, departure.given.pose)));
    const bool stays = options.only_rests && is_same(start.pose, target);
    const PathOutcome outcome = stays
        ? PathOutcome { 1, 1 }
        : follow_path(motion, path, weights, options, recorder, progress.part(0, k_progress_of_path));

    RecoverResult result;
    if (outcome.ended_early()) {
        if (!outcome.out_of_time)
            result.held_back = list_held_back_parts(motion.obstacle(), path.bridged_at(outcome.share), rig.weights);
        motion.restore(outcome.state_in_place);
    } else {
        motion.advect_obstacle(path.withdrawn_end());
        motion.advect_obstacle(path.end());
    }
    const Positions end = path.at(outcome.reached());
    result.pose = slerp(start.pose, target, outcome.reached());
    result.garments = start.garments;
    const bool in_place
        = come_to_rest(motion, end, outcome.ended_early() ? Quality::draft : options.quality, options,
                       { rig, start, body.surface.triangles }, result, progress.part(k_progress_of_path, 1));
    if (!outcome.ended_early())
        recorder.record(motion, 1);

    for (WornGarment& garment : result.garments)
        if (garment.pieces.count == 0)  // not from drape_garment
            garment.pieces = count_pieces_held(garment.rest);
    measure_piece_shifts(result.garments);
    add_slips(result.garments,
              skin(outfit.cloth.positions, weights.cloth,
                   relative_transforms(path.transforms(0), path.transforms(outcome.reached()))));
    if (!outcome.ended_early())
        result.held_back = list_held_back_parts(result.body, end, rig.weights);
    result.frames = std::move(recorder).take();
    result.pose_reached = outcome.reached();
    result.out_of_time |= outcome.out_of_time;
    result.seconds = motion.seconds();
    const bool clean = certify_all(result.garments, { result.body, body.surface.triangles });
    result.certified = clean && in_place && !outcome.ended_early() && result.too_tight.empty();
    if (!result.certified && !result.out_of_time)
        result.overlaps = find_overlaps({ path.end(), body.surface.triangles }, rig.weights,
                                        mark_near_cloth(result.body, motion.cloth()));
    return result;
}

/// Whether cloth holds skin far from its place at the end of the path.
bool is_stuck(const RecoverResult& result)
{
    return !result.held_back.empty() && result.held_back.front().distance > k_stuck_lag;
}

RecoverResult recover_on(const Rig& rig, const BodyMesh& body, const DressedBody& dressed, const Pose& target,
                         const RecoverOptions& options, const Progress& progress)
{
    DressedBody carried = carry_to_root(rig, dressed, target);
    const Outfit outfit(carried.garments, options.cloth.fabric);
    const Departure departure { dressed, std::move(carried), outfit };
    RecoverResult result = recover_over(BridgeEnds::bottom, rig, body, departure, target, options, progress);
    if (result.certified || result.out_of_time || (result.pose_reached == 1 && !is_stuck(result)))
        return result;
    RecoverResult other = recover_over(BridgeEnds::nearest, rig, body, departure, target, options, progress);
    other.seconds += result.seconds;
    const bool is_better = other.pose_reached != result.pose_reached
        ? other.pose_reached > result.pose_reached
        : other.certified || (is_stuck(result) && !is_stuck(other));
    return is_better ? other : result;
}

/// Lets the body go from where it is laid to its own skin, and the garments find their rest on that.
void rest_on_own_skin(RecoverResult& result, const Rig& rig, const BodyMesh& body, const RecoverOptions& options,
                      const Progress& progress)
{
    RecoverResult rest = rest_on_body(rig, body, result, options, progress);
    rest.frames = std::move(result.frames);
    rest.seconds += result.seconds;
    result = std::move(rest);
}

}  // namespace

RecoverResult rest_on_body(const Rig& rig, const BodyMesh& body, const DressedBody& dressed, RecoverOptions options,
                           const Progress& progress)
{
    options.settling_steps = k_own_skin_steps;
    options.frames = 0;
    options.only_rests = true;
    return recover_on(rig, body, dressed, dressed.pose, options, progress);
}

const std::vector<std::string_view>& quality_names()
{
    static const std::vector<std::string_view> names { "standard", "draft" };
    return names;
}

RecoverResult recover_pose(const Rig& rig, const BodyMesh& body, const DressedBody& dressed, const Pose& target,
                           const RecoverOptions& options, const Progress& progress)
{
    const auto recover = [&](const Rig& on, const BodyMesh& skin, const DressedBody& worn, const Progress& part) {
        return recover_on(on, skin, worn, target, options, part);
    };
    return move_sewn(rig, body, dressed, progress,
                     [&](const Rig& on, const BodyMesh& skin, const DressedBody& worn, const Progress& part) {
                         return move_coarse(on, skin, worn, part, recover,
                                            [&](RecoverResult& result, bool has_own_skin, const Progress& rest) {
                                                if (!has_own_skin || options.quality == Quality::standard)
                                                    rest_on_own_skin(result, on, skin, options, rest);
                                            });
                     });
}

}  // namespace garmentfit
