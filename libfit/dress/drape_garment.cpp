// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/drape_garment.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "append_mesh.h"
#include "body_parts.h"
#include "cloth_motion.h"
#include "collapse.h"
#include "creases.h"
#include "garmentfit/error.h"
#include "garmentfit/fit_skeleton.h"
#include "held_back.h"
#include "layers.h"
#include "skin_weights.h"
#include "sleeve_retraction.h"
#include "straight_hands.h"
#include "tightness.h"
#include "untangle.h"
#include "weld.h"

namespace garmentfit {
namespace {

// The shares of its thickness that the body may start with. The first is under two millimetres for a limb; the others are for bones that
// run nearer to the cloth. None leaves faces without area.
constexpr std::array<double, 3> k_first_sizes { 0.01, 0.003, 0.001 };
// Where one part stops the inflation, others beyond this share of the limit are worth naming, too.
constexpr double k_worth_naming = 0.7;

/// What the garment meets: the body and the garments under it, anywhere between its bones and its full size.
struct Inflatable {
    TriangleMesh full;
    Positions bridged;  // full, but for the body's creases
    Positions withdrawn;  // full, with what is in creases drawn back from them
    Positions core;
    Skeleton bones;  // that the core lies on
    std::vector<double> grown;  // of each vertex, the least size that it ever has

    Positions at(double size) const
    {
        Positions result = core;
        for (Eigen::Index v = 0; v < core.rows(); ++v)
            result.row(v) += std::max(size, grown[v]) * (bridged.row(v) - core.row(v));
        return result;
    }
};

/// @param pushed  hands and feet that it frees are of full size from the start; none: all of the body is thin
Inflatable inflatable(const Rig& rig, const BodyMesh& body, const Pose& pose, const GarmentMesh& garment,
                      const std::vector<WornGarment>& worn, const Positions& left, const SleeveRetraction* pushed)
{
    Inflatable result;
    const Eigen::Index body_vertices = body.surface.positions.rows();
    const StraightHands hands(rig, body.surface.positions);
    const StraightHands::Stretch stretch = worn.empty() ? hands.clear_of(garment, pose) : hands.of(left, pose);
    result.full
        = { skin(hands.stretched(stretch), rig.weights, bone_transforms(rig.skeleton, pose)), body.surface.triangles };
    SkinWeights weights = rig.weights;
    for (const WornGarment& under : worn) {
        append(weights, weights_of_nearest(under.positions, result.full.positions.topRows(body_vertices), rig.weights));
        append(result.full, { under.positions, under.rest.triangles });
    }
    const Skeleton joints = pose_skeleton(hands.skeleton(stretch), pose);
    // a hand or foot that would still poke through the cloth grows out of its wrist or ankle instead
    result.bones = retract_tips(joints, garment);
    result.core = collapse(result.full.positions, weights, result.bones);
    result.grown
        = pushed ? pushed->freed(result.full.positions, weights, joints) : std::vector<double>(result.core.rows(), 0);
    const Positions skinned = result.full.positions.topRows(body_vertices);
    TriangleMesh cloth { garment.positions, garment.triangles };
    for (const WornGarment& under : worn)
        append(cloth, { under.positions, under.rest.triangles });
    const Creases creases({ skinned, body.surface.triangles }, near_cloth(skinned, cloth.positions));
    result.bridged = result.withdrawn = result.full.positions;
    result.bridged.topRows(body_vertices) = creases.bridged();
    result.withdrawn.topRows(body_vertices) = creases.withdrawn(result.core.topRows(body_vertices));
    return result;
}

std::string place(const Vec3& p)
{
    const auto number = [](double x) { return std::to_string(x).substr(0, std::to_string(x).find('.') + 3); };
    return '(' + number(p.x()) + ", " + number(p.y()) + ", " + number(p.z()) + ") m";
}

struct Crossings {
    std::vector<Crossing> through_body, through_cloth;  // edges of the one through faces of the other
    bool none() const { return through_body.empty() && through_cloth.empty(); }
};

Crossings crossings_at(double size, const Inflatable& inside, const TriangleMesh& cloth)
{
    const TriangleMesh body { inside.at(size), inside.full.triangles };
    return { crossings(cloth, body), crossings(body, cloth) };
}

[[noreturn]] void refuse(const Crossings& found, const Inflatable& inside, const SkinWeights& weights)
{
    const int vertex = found.through_body.empty()
        ? edges_of(inside.full.triangles)(found.through_cloth.front().first, 0)
        : inside.full.triangles(found.through_body.front().second, 0);
    const std::string what = vertex < weights.bones.rows() ? "bone " + std::string(bone_name(weights.bones(vertex, 0)))
                                                           : std::string("a garment worn under it");
    throw InvalidInput("drape: the garment passes through the body's skeleton, " + what + " at "
                       + place(inside.core.row(vertex)) + "; fit the skeleton to this garment first, or give its type");
}

Vec3 nearest_joint(const Vec3& p, const Skeleton& bones)
{
    Vec3 nearest = bones.root;
    for (const Vec3& joint : bones.tails)
        if ((joint - p).squaredNorm() < (nearest - p).squaredNorm())
            nearest = joint;
    return nearest;
}

/// Faces that span a joint cut its corner, where a hem or a cuff may lie. Drawn along the bones to the joint, which no cloth
/// comes between, they do not.
void tuck_corners(Inflatable& inside, const TriangleMesh& cloth)
{
    const auto edges = edges_of(inside.full.triangles);
    bool tucked = true;
    const auto tuck = [&](int vertex) {
        const Vec3 joint = nearest_joint(inside.core.row(vertex), inside.bones);
        tucked |= inside.core.row(vertex) != joint.transpose();
        inside.core.row(vertex) = joint;
    };
    while (tucked) {
        tucked = false;
        const Crossings found = crossings_at(k_first_sizes.back(), inside, cloth);
        for (const Crossing& c : found.through_body)
            for (int k = 0; k < 3; ++k)
                tuck(inside.full.triangles(c.second, k));
        for (const Crossing& c : found.through_cloth)
            for (int k = 0; k < 2; ++k)
                tuck(edges(c.first, k));
    }
}

/// The largest of the sizes to start with that is free of the garment, if any is.
std::optional<double> first_size(Inflatable& inside, const GarmentMesh& garment)
{
    const TriangleMesh cloth { garment.positions, garment.triangles };
    const auto largest_free = [&]() -> std::optional<double> {
        for (const double size : k_first_sizes)
            if (crossings_at(size, inside, cloth).none())
                return size;
        return {};
    };
    if (const auto size = largest_free())
        return size;
    tuck_corners(inside, cloth);
    return largest_free();
}

/// The garment with its sleeves and legs pushed up, where no pairs cross each other then that did not as it was given: what lies in
/// narrow folds may, for triangles stay flat, and mostly comes apart.
std::optional<Positions> without_new_crossings(const SleeveRetraction& pushed, const GarmentMesh& garment)
{
    const Weld weld(garment);
    const GarmentMesh given = weld.gathered(garment);
    const Untangled up = untangle({ weld.gathered(pushed.positions()), given.triangles });
    if (!up.left.empty())
        if (const std::vector<Crossing> crossed = self_crossings({ given.positions, given.triangles });
            !std::includes(crossed.begin(), crossed.end(), up.left.begin(), up.left.end()))
            return {};
    return weld.placed(up.positions);
}

/// How draping begins.
struct Start {
    Positions cloth;
    Inflatable inside;
    double size;  ///< of what is inside
};

/// With sleeves and legs pushed up, where that leaves the body free of the cloth.
Start start(const Rig& rig, const BodyMesh& body, const Pose& pose, const GarmentMesh& garment,
            const std::vector<WornGarment>& worn, const Positions& left)
{
    if (const SleeveRetraction pushed(pose_skeleton(rig.skeleton, pose), garment); pushed.any())
        if (const auto positions = without_new_crossings(pushed, garment)) {
            const GarmentMesh up { *positions, garment.triangles };
            Inflatable inside = inflatable(rig, body, pose, up, worn, left, &pushed);
            if (const auto size = first_size(inside, up))
                return { up.positions, std::move(inside), *size };
        }
    Inflatable inside = inflatable(rig, body, pose, garment, worn, left, nullptr);
    if (const auto size = first_size(inside, garment))
        return { garment.positions, std::move(inside), *size };
    refuse(crossings_at(k_first_sizes.back(), inside, { garment.positions, garment.triangles }), inside, rig.weights);
}

/// A garment that may be made larger while the body grows in it, all of it alike.
class Grading {
public:
    Grading(const GarmentMesh& given, const SkinWeights& follows, const Skeleton& skeleton, int index,
            const ClothOptions& cloth) :
        given_(given),
        follows_(follows), skeleton_(skeleton), index_(index), cloth_(cloth),
        tightness_(given, follows, skeleton, index)
    {
    }

    /// Whether the garment is big enough for what it is drawn over now, if need be after having been enlarged.
    bool fits(ClothMotion& motion)
    {
        const double stretch = tightness_.largest_stretch(motion.cloth());
        if (stretch <= cloth_.largest_stretch)
            return true;
        // to half of the stretch that is allowed, so that it is not due again at the next step
        const double larger = size_ * (1 + stretch) / (1 + 0.5 * cloth_.largest_stretch);
        if (larger > 1 + cloth_.largest_enlargement)
            return false;
        size_ = larger;
        motion.set_rest(garment());
        tightness_ = Tightness(garment(), follows_, skeleton_, index_);
        return true;
    }

    const Tightness& tightness() const { return tightness_; }
    double size() const { return size_; }
    GarmentMesh garment() const { return { size_ * given_.positions, given_.triangles }; }

private:
    const GarmentMesh& given_;
    const SkinWeights& follows_;
    Skeleton skeleton_;
    int index_;
    const ClothOptions& cloth_;
    double size_ = 1;
    Tightness tightness_;
};

/// Inflates the body inside the garment. @return the size reached: 1, or less where the cloth would stretch too far.
double inflate(ClothMotion& motion, const Inflatable& inside, double first, Grading& grading,
               const DrapeOptions& options, const Progress& progress)
{
    MotionStep step;
    step.largest_move = step.largest_obstacle_move = 1e-2;
    for (int i = 1; i <= options.inflation_steps; ++i) {
        progress.at(double(i) / options.inflation_steps);
        const double size = first + (1 - first) * i / options.inflation_steps;
        const Positions target = inside.at(size);
        step.obstacle_target = &target;
        motion.advance(step);
        if (!grading.fits(motion))
            return size < 1 ? size : 1 - 1e-3;
    }
    const Positions bridged = inside.at(1);
    step.obstacle_target = &bridged;
    step_until_converged(motion, step);
    motion.advect_obstacle(inside.withdrawn);
    motion.advect_obstacle(inside.full.positions);
    return 1;
}

}  // namespace

bool certify_all(std::vector<WornGarment>& garments, const TriangleMesh& body)
{
    bool clean = true;
    std::vector<TriangleMesh> under;
    for (WornGarment& garment : garments) {
        garment.certificate = certify(body, garment.rest, garment.positions, under);
        clean &= garment.certificate.clean();
        under.push_back({ garment.positions, garment.rest.triangles });
    }
    return clean;
}

DrapeResult drape_garment(const Rig& rig, const BodyMesh& body, const DressedBody& wearer, const GarmentMesh& garment,
                          const DrapeOptions& options, const Progress& progress)
{
    const Pose& pose = wearer.pose;
    const std::vector<WornGarment>& worn = wearer.garments;
    const Positions& left = wearer.body;
    require_wearable_size(rig, garment);
    const auto [cloth, inside, first] = start(rig, body, pose, garment, worn, left);

    const Eigen::Index body_vertices = body.surface.positions.rows();
    const SkinWeights follows
        = weights_of_nearest(garment.positions, inside.full.positions.topRows(body_vertices), rig.weights);
    Grading grading(garment, follows, pose_skeleton(rig.skeleton, pose), int(worn.size()), options.cloth);
    ClothMotion motion(garment, cloth, { inside.at(first), inside.full.triangles }, options.cloth);

    DrapeResult result;
    result.pose = pose;
    result.size_reached = inflate(motion, inside, first, grading, options, progress.part(0, 0.7));
    if (result.size_reached < 1) {
        const PerPart growth
            = growth_left(motion.cloth(), motion.obstacle().topRows(body_vertices),
                          inside.full.positions.topRows(body_vertices), rig.weights, pose_skeleton(rig.skeleton, pose));
        result.too_tight
            = grading.tightness().too_tight(motion.cloth(), k_worth_naming * options.cloth.largest_stretch, growth);
    } else {
        result.speed = settle(motion, inside.full.positions, options.settling_steps, 0, progress.part(0.7, 1)).speed;
    }

    result.seconds = motion.seconds();
    const Positions reached = motion.obstacle();
    result.body = reached.topRows(body_vertices);
    std::vector<WornGarment> outermost { { grading.garment(), motion.cloth(), {}, grading.size() } };
    add_slips(outermost, outermost[0].rest.positions);
    result.garments = worn;
    put_positions(result.garments, reached.bottomRows(reached.rows() - body_vertices));
    result.garments.push_back(outermost[0]);
    const bool clean = certify_all(result.garments, { result.body, body.surface.triangles });
    if (result.size_reached == 1)
        result.held_back = held_back(result.body, inside.full.positions.topRows(body_vertices), rig.weights);
    result.certified = clean && reached == inside.full.positions;
    if (!clean && result.size_reached < 1 && !worn.empty()) {
        // while all of it grows, body and inner garments need not keep clear of each other: they are handed out as they were
        result.garments = worn;
        result.body = left.rows() > 0 ? left : Positions(inside.full.positions.topRows(body_vertices));
    }
    return result;
}

}  // namespace garmentfit
