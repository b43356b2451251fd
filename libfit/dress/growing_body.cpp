// SPDX-License-Identifier: GPL-3.0-or-later
#include "growing_body.h"

#include <algorithm>
#include <string>

#include "append_mesh.h"
#include "collapse.h"
#include "creases.h"
#include "garmentfit/error.h"
#include "garmentfit/fit_skeleton.h"
#include "garmentfit/number_text.h"
#include "skin_weights.h"
#include "sleeve_retraction.h"
#include "tuning.h"

namespace garmentfit {
namespace {

// ---- making it ---------------------------------------------------------------------------------------------------

void bridge_creases(GrowingBody& inside, const Wearer& wearer, const GarmentMesh& garment)
{
    TriangleMesh cloth { garment.positions, garment.triangles };
    for (const WornGarment& under : wearer.dressed.garments)
        append(cloth, { under.positions, under.rest.triangles });
    const Positions skin = inside.body_of(inside.full.positions);
    const Creases creases({ skin, wearer.body.surface.triangles }, mark_near_cloth(skin, cloth.positions));
    inside.bridged = inside.withdrawn = inside.full.positions;
    inside.bridged.topRows(inside.body_vertices) = creases.bridged_surface();
    inside.withdrawn.topRows(inside.body_vertices) = creases.withdrawn_surface(inside.body_of(inside.core));
}

// ---- where it crosses the cloth ----------------------------------------------------------------------------------

struct Crossings {
    std::vector<Crossing> through_body, through_cloth;  // edges of the one through faces of the other
    bool none() const { return through_body.empty() && through_cloth.empty(); }
};

Crossings find_crossings(const GrowingBody& inside, double scale, const TriangleMesh& cloth)
{
    const TriangleMesh body { inside.at(scale), inside.full.triangles };
    return { crossings(cloth, body), crossings(body, cloth) };
}

std::optional<double> find_largest_free_scale(const GrowingBody& inside, const TriangleMesh& cloth)
{
    const auto free = std::find_if(k_initial_body_scales.begin(), k_initial_body_scales.end(),
                                   [&](double scale) { return find_crossings(inside, scale, cloth).none(); });
    return free == k_initial_body_scales.end() ? std::nullopt : std::optional(*free);
}

// The joint at the end of each bone, and the root, which has no bone.
constexpr int k_at_root = -1;

Vec3 place_of(int joint, const Skeleton& bones) { return joint == k_at_root ? bones.root : bones.tail(joint); }

int nearest_joint(const Vec3& p, const Skeleton& bones)
{
    int nearest = k_at_root;
    for (int b = 0; b < bone_count; ++b)
        if ((bones.tail(b) - p).squaredNorm() < (place_of(nearest, bones) - p).squaredNorm())
            nearest = b;
    return nearest;
}

int joint_before(int joint) { return joint == k_at_root ? k_at_root : parent_of(joint); }

// Joints on the way to the root, the root among them.
int depth(int joint) { return joint == k_at_root ? 0 : 1 + depth(joint_before(joint)); }

// One bone along the skeleton.
int step_towards(int from, int to)
{
    const int to_depth = depth(to), from_depth = depth(from);
    int ancestor = to, next = to;
    for (int d = to_depth; d > from_depth; --d) {
        next = ancestor;
        ancestor = joint_before(ancestor);
    }
    return ancestor == from ? next : joint_before(from);
}

bool are_joined(int a, int b) { return a == b || joint_before(a) == b || joint_before(b) == a; }

/// Draws faces that cross the cloth along the bones to their joint, until none crosses or all are there: no cloth lies
/// between. A face that still crosses spans several bones, such as thorax and clavicle round an armhole: its end nearer
/// to the root moves along the bones towards the other.
void tuck_corners(GrowingBody& inside, const TriangleMesh& cloth)
{
    const auto edges = edges_of(inside.full.triangles);
    bool tucked = true;
    const auto tuck_to = [&](int vertex, int joint) {
        const Vec3 place = place_of(joint, inside.bones);
        tucked |= inside.core.row(vertex) != place.transpose();
        inside.core.row(vertex) = place;
    };
    const auto tuck = [&](int a, int b) {
        const int at_a = nearest_joint(inside.core.row(a), inside.bones),
                  at_b = nearest_joint(inside.core.row(b), inside.bones);
        const bool a_moves = depth(at_a) < depth(at_b);
        const bool joined = are_joined(at_a, at_b);
        tuck_to(a, !joined && a_moves ? step_towards(at_a, at_b) : at_a);
        tuck_to(b, !joined && !a_moves ? step_towards(at_b, at_a) : at_b);
    };
    for (int round = 0; tucked && round < k_most_tucks; ++round) {
        tucked = false;
        const Crossings found = find_crossings(inside, k_initial_body_scales.back(), cloth);
        for (const Crossing& c : found.through_body)
            for (int k = 0; k < 3; ++k)
                tuck(inside.full.triangles(c.second, k), inside.full.triangles(c.second, (k + 1) % 3));
        for (const Crossing& c : found.through_cloth)
            tuck(edges(c.first, 0), edges(c.first, 1));
    }
}

}  // namespace

Positions GrowingBody::at(double scale) const { return shrink(bridged, scale); }

Positions GrowingBody::shrink(const Positions& grown, double scale) const
{
    Positions result = core;
    for (Eigen::Index v = 0; v < core.rows(); ++v)
        result.row(v) += std::max(scale, min_scale[v]) * (grown.row(v) - core.row(v));
    return result;
}

GrowingBody make_growing_body(const Wearer& wearer, const GarmentMesh& garment, const SleeveRetraction* retraction)
{
    const auto& [rig, body, dressed, hands, joints] = wearer;
    GrowingBody result;
    result.body_vertices = body.surface.positions.rows();
    const HandStretch::Shares stretch = dressed.garments.empty() ? hands.find_clear_stretch(garment, dressed.pose)
                                                                 : hands.find_stretch(dressed.body, dressed.pose);
    result.full = { skin(hands.stretch_skin(stretch), rig.weights, bone_transforms(rig.skeleton, dressed.pose)),
                    body.surface.triangles };
    SkinWeights weights = rig.weights;
    for (const WornGarment& under : dressed.garments) {
        append(weights, weights_of_nearest(under.positions, result.body_of(result.full.positions), rig.weights));
        append(result.full, { under.positions, under.rest.triangles });
    }
    const Skeleton stretched = pose_skeleton(hands.stretch_skeleton(stretch), dressed.pose);
    // a hand or foot that would still cross the cloth grows out of its wrist or ankle instead
    result.bones = retract_tips(stretched, garment);
    result.core = collapse(result.full.positions, weights, result.bones);
    result.min_scale = retraction ? retraction->min_scales(result.full.positions, weights, stretched)
                                  : std::vector<double>(result.core.rows(), 0);
    bridge_creases(result, wearer, garment);
    return result;
}

std::optional<double> find_initial_scale(GrowingBody& inside, const TriangleMesh& cloth)
{
    if (const auto scale = find_largest_free_scale(inside, cloth))
        return scale;
    tuck_corners(inside, cloth);
    return find_largest_free_scale(inside, cloth);
}

void refuse(const GrowingBody& inside, const TriangleMesh& cloth, const SkinWeights& weights)
{
    const Crossings found = find_crossings(inside, k_initial_body_scales.back(), cloth);
    const int vertex = found.through_body.empty()
        ? edges_of(inside.full.triangles)(found.through_cloth.front().first, 0)
        : inside.full.triangles(found.through_body.front().second, 0);
    const std::string what = vertex < weights.bones.rows() ? "bone " + std::string(bone_name(weights.bones(vertex, 0)))
                                                           : std::string("a garment worn under it");
    throw InvalidInput(ErrorCode::crossing_start,
                       "garment: in the fitted pose its cloth lies across the bones of the body, " + what + " at "
                           + place_text(inside.core.row(vertex))
                           + ", so that no body can grow from there; check the garment's unit, and give its type or "
                             "its front");
}

}  // namespace garmentfit
