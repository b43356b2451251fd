// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/recover_pose.h"

#include <algorithm>
#include <cmath>

#include "append_mesh.h"
#include "body_parts.h"
#include "cloth_motion.h"
#include "collapse.h"
#include "creases.h"
#include "garmentfit/error.h"
#include "held_back.h"
#include "layers.h"
#include "overlaps.h"
#include "skin_weights.h"
#include "straight_hands.h"
#include "tightness.h"

namespace garmentfit {
namespace {

// Passes over the edges that even out how the cloth hangs on the bones: what lies between two limbs follows both.
constexpr int k_smoothing_passes = 30;
// A body that moves works its clothes loose: this share of the friction is left.
constexpr double k_moving_friction = 0.25;
// What still creeps at the end gets so many time steps more to come to rest.
constexpr int k_steps_to_rest = 60;
// With no part of the body further than this from its place (metres), a pose counts as reached on the way.
constexpr double k_in_place = 1e-3;
// Where cloth holds a part of the body back by this much (metres) more than at the start, there is no room for it further on: it would only
// be torn. On ways that end well no part that was in place lags by more than 0.02, but hands that cross come to 0.07; a foot may stand in a
// trouser leg from the start.
constexpr double k_stuck = 0.08;

BoneTransforms between(const BoneTransforms& from, const BoneTransforms& to)
{
    BoneTransforms result;
    for (int b = 0; b < bone_count; ++b)
        result[b] = to[b] * from[b].inverse();
    return result;
}

/// The body on its way from one pose to another.
class Way {
public:
    Way(const Rig& rig, const BodyMesh& body, const Pose& from, const Pose& to, const Positions& start,
        const Positions& cloth) :
        rig_(rig),
        hands_(rig, body.surface.positions), stretch_(hands_.of(start, from)), from_(from), to_(to), last_(at(1)),
        creases_({ last_, body.surface.triangles }, near_cloth(at(0), cloth))
    {
    }

    BoneTransforms transforms(double t) const { return bone_transforms(rig_.skeleton, slerp(from_, to_, t)); }
    Positions at(double t) const { return skin(hands_.stretched(stretch(t)), rig_.weights, transforms(t)); }

    const Positions& last() const { return last_; }  ///< at(1)

    /// With the creases of the last pose bridged, more and more up to half of the way. Bridges move as the skin below them does.
    Positions bridged(double t) const
    {
        const BoneTransforms along = between(transforms(1), transforms(t));
        const Positions lifted = skin(creases_.bridged(), rig_.weights, along) - skin(last_, rig_.weights, along);
        return at(t) + std::min(1.0, 2 * t) * lifted;
    }

    /// The last pose, with what is in creases drawn back from them.
    Positions withdrawn() const
    {
        return creases_.withdrawn(collapse(last_, rig_.weights, pose_skeleton(rig_.skeleton, to_)));
    }

    /// Metres that the vertex of the cloth with the longest way is carried. Bare hands go further, but they carry nothing.
    double length(const Positions& cloth, const SkinWeights& weights) const
    {
        constexpr int k_chords = 20;
        const BoneTransforms start = transforms(0);
        double sum = 0;
        Positions before = cloth;
        for (int i = 1; i <= k_chords; ++i) {
            const Positions here = skin(cloth, weights, between(start, transforms(double(i) / k_chords)));
            sum += (here - before).rowwise().norm().maxCoeff();
            before = here;
        }
        return sum;
    }

private:
    /// Hands that were stretched out to put garments on are bent back on the way to the own pose.
    StraightHands::Stretch stretch(double t) const
    {
        const double left = is_same(to_, Pose()) ? 1 - t : 1;
        return { left * stretch_[0], left * stretch_[1] };
    }

    const Rig& rig_;
    StraightHands hands_;
    StraightHands::Stretch stretch_;  // at the start
    const Pose &from_, &to_;
    Positions last_;
    Creases creases_;
};

SkinWeights smooth(const SkinWeights& weights, const Triangles& triangles)
{
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(weights.bones.rows(), bone_count);
    for (Eigen::Index v = 0; v < dense.rows(); ++v)
        for (int k = 0; k < 4; ++k)
            dense(v, weights.bones(v, k)) += weights.weights(v, k);
    const auto edges = edges_of(triangles);
    for (int pass = 0; pass < k_smoothing_passes; ++pass) {
        Eigen::MatrixXd sum = dense;
        Eigen::VectorXd count = Eigen::VectorXd::Ones(dense.rows());
        for (Eigen::Index e = 0; e < edges.rows(); ++e) {
            sum.row(edges(e, 0)) += dense.row(edges(e, 1));
            sum.row(edges(e, 1)) += dense.row(edges(e, 0));
            count[edges(e, 0)] += 1;
            count[edges(e, 1)] += 1;
        }
        dense = sum.array().colwise() / count.array();
    }
    return strongest_four(dense);
}

/// A body in some pose, and what it wears.
struct Worn {
    const std::vector<WornGarment>& garments;
    const Positions& body;
    Skeleton skeleton;
};

/// Which garments are too small for a pose that they were big enough for in another, before. What was wider there than it may stretch is
/// caught, not tight.
std::vector<TooTight> too_tight(const Worn& before, const Worn& now, const SkinWeights& weights, double allowed)
{
    std::vector<TooTight> result;
    for (std::size_t i = 0; i < now.garments.size(); ++i) {
        const WornGarment& garment = now.garments[i];
        const Tightness tightness(garment.rest, weights_of_nearest(garment.positions, now.body, weights), now.skeleton,
                                  int(i));
        const std::vector<TooTight> tight = tightness.too_tight_at_rest(garment.positions, allowed);
        if (tight.empty())
            continue;
        const auto wider = slack(before.garments[i].positions, before.body, weights, before.skeleton);
        for (const TooTight& part : tight)
            for (int p = 0; p < k_body_parts; ++p)
                if (part.part == part_name(p) && wider[p] <= allowed)
                    result.push_back(part);
    }
    return result;
}

/// Keeps states on the way, evenly spread.
class Recording {
public:
    Recording(const std::vector<WornGarment>& worn, const Triangles& body, int frames) :
        worn_(worn), body_(body), frames_(frames)
    {
    }

    /// Keeps the state when its turn has come, and only if it is certified: a frame that is shown is a state handed out.
    void see(const ClothMotion& motion, double share)
    {
        const double next = frames_ == 1 ? 1 : double(seen_) / (frames_ - 1);
        if (frames_ == 0 || share < next - 1e-9)
            return;
        ++seen_;
        put_positions(worn_, motion.cloth());
        if (!certify_all(worn_, { motion.obstacle(), body_ }))
            return;
        kept_.push_back({ share, motion.obstacle(), {} });
        for (const WornGarment& garment : worn_)
            kept_.back().garments.push_back(garment.positions);
    }

    std::vector<RecoverFrame> take() && { return std::move(kept_); }

private:
    std::vector<WornGarment> worn_;
    const Triangles& body_;
    int frames_, seen_ = 0;
    std::vector<RecoverFrame> kept_;
};

struct Gone {
    double in_place = 0;  ///< the last share of the way at which the whole body was in its place
    Positions state;  ///< of the motion, there
    double share = 0;  ///< how far the way was gone: 1, or less where the body got stuck
};

/// Moves body and cloth along the way.
Gone go(ClothMotion& motion, const Way& way, const SkinWeights& body_weights, const SkinWeights& cloth_weights,
        const RecoverOptions& options, Recording& recording, const Progress& progress)
{
    const double length = way.length(motion.cloth(), cloth_weights);
    const int needed = std::clamp(int(std::ceil(length / options.step_length)), 1, options.largest_steps);
    const int steps = std::max(needed, options.frames - 1);  // a frame is where a step ends
    MotionStep step;
    step.gravity = k_gravity;
    step.friction_share = k_moving_friction;
    Gone gone { 0, motion.state(), 0 };
    const double stuck = k_stuck + (motion.obstacle() - way.at(0)).rowwise().norm().maxCoeff();
    for (int i = 1; i <= steps; ++i) {
        progress.at(double(i) / steps);
        const double t = double(i) / steps;
        const BoneTransforms along = between(way.transforms(double(i - 1) / steps), way.transforms(t));
        const Positions cloth = motion.cloth(), body = motion.obstacle(), target = way.bridged(t);
        motion.advect(skin(cloth, cloth_weights, along) - cloth, skin(body, body_weights, along) - body);
        step.obstacle_target = &target;
        double lag = motion.advance(step);
        if (lag > stuck)
            lag = step_until_converged(motion, step);  // it may only be slow
        gone.share = t;
        if (lag < k_in_place) {
            gone.in_place = t;
            gone.state = motion.state();
        }
        if (lag > stuck)
            return gone;
        if (i < steps)
            recording.see(motion, t);
    }
    const Positions bridged = way.bridged(1);
    step.obstacle_target = &bridged;
    step_until_converged(motion, step);
    return gone;
}

}  // namespace

RecoverResult recover_pose(const Rig& rig, const BodyMesh& body, const DressedBody& dressed, const Pose& to,
                           const RecoverOptions& options, const Progress& progress)
{
    const Pose& from = dressed.pose;
    const std::vector<WornGarment>& worn = dressed.garments;
    const Positions& start_positions = dressed.body;
    RecoverResult result;
    result.garments = worn;
    TriangleMesh rest, cloth;
    for (const WornGarment& garment : worn) {
        append(rest, { garment.rest.positions, garment.rest.triangles });
        append(cloth, { garment.positions, garment.rest.triangles });
    }
    const Way way(rig, body, from, to, start_positions, cloth.positions);
    const TriangleMesh start { start_positions.rows() > 0 ? start_positions : way.at(0), body.surface.triangles };
    if (const int crossing = crossing_count(cloth, start); crossing > 0)
        throw InvalidInput("recover: garment and body cross at " + std::to_string(crossing)
                           + " places at the start; drape the garment first");

    const SkinWeights cloth_weights
        = smooth(weights_of_nearest(cloth.positions, start.positions, rig.weights), cloth.triangles);
    ClothMotion motion({ rest.positions, rest.triangles }, cloth.positions, start, options.cloth);
    Recording recording(worn, body.surface.triangles, options.frames);
    recording.see(motion, 0);
    const Gone gone = go(motion, way, rig.weights, cloth_weights, options, recording, progress.part(0, 0.8));
    const bool stuck = gone.share < 1;
    if (stuck) {
        result.held_back = held_back(motion.obstacle(), way.bridged(gone.share), rig.weights);
        motion.restore(gone.state);
    } else {
        motion.advect_obstacle(way.withdrawn());
        motion.advect_obstacle(way.last());
    }
    const double reached = stuck ? gone.in_place : 1;
    result.pose = slerp(from, to, reached);
    const Positions end = way.at(reached);
    const auto [arrived, speed] = settle(motion, end, options.settling_steps, k_steps_to_rest, progress.part(0.8, 1));

    if (!stuck)
        recording.see(motion, 1);
    result.frames = std::move(recording).take();

    put_positions(result.garments, motion.cloth());
    add_slips(result.garments,
              skin(cloth.positions, cloth_weights, between(way.transforms(0), way.transforms(reached))));
    result.body = motion.obstacle();
    if (!stuck)
        result.held_back = held_back(result.body, end, rig.weights);
    result.too_tight = too_tight({ worn, start.positions, pose_skeleton(rig.skeleton, from) },
                                 { result.garments, result.body, pose_skeleton(rig.skeleton, result.pose) },
                                 rig.weights, options.cloth.largest_stretch);
    result.speed = speed;
    result.seconds = motion.seconds();
    result.pose_reached = reached;
    const bool clean = certify_all(result.garments, { result.body, body.surface.triangles });
    result.certified = clean && arrived && !stuck && result.too_tight.empty();
    if (!result.certified)
        result.overlaps
            = overlaps({ way.last(), body.surface.triangles }, rig.weights, near_cloth(result.body, motion.cloth()));
    return result;
}

}  // namespace garmentfit
