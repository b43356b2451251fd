// SPDX-License-Identifier: GPL-3.0-or-later
#include "missing_joints.h"

#include <algorithm>
#include <string>
#include <utility>

#include "tuning.h"

namespace garmentfit {
namespace {

/// The nearest joint with a name, from this row upwards; -1: none.
int named_from(const FileSkin& skin, const NamedJoints& joints, int row)
{
    while (row >= 0 && !joints[std::size_t(row)])
        row = skin.parents[std::size_t(row)];
    return row;
}

/// What mostly hangs on a joint, on those below it that have no names, or on others of its kind and side, such as the
/// volumes of Second Life.
std::vector<Vec3> skin_of(const FileSkin& skin, const NamedJoints& joints, int row)
{
    const auto is_own = [&](int joint) {
        const int named = named_from(skin, joints, joint);
        return named >= 0 && joints[std::size_t(named)]->kind == joints[std::size_t(row)]->kind
            && joints[std::size_t(named)]->side == joints[std::size_t(row)]->side;
    };
    std::vector<Vec3> points;
    for (std::size_t v = 0; v < skin.hangs.size(); ++v) {
        double own = 0, all = 0;
        for (const auto& [joint, weight] : skin.hangs[v]) {
            all += weight;
            if (is_own(joint))
                own += weight;
        }
        if (own > 0.5 * all)
            points.emplace_back(skin.positions.row(Eigen::Index(v)));
    }
    return points;
}

/// Directions from a joint to points, weighted by distance.
struct Directions {
    Vec3 sum = Vec3::Zero();
    double lengths = 0;

    void add(const Vec3& way)
    {
        sum += way;
        lengths += way.norm();
    }
    /// Whether they mostly point the same way.
    bool agree() const { return sum.norm() > k_directions_agree * lengths; }
};

/// From a joint through the skin that lies neither at it nor at the end, as toes and thumbs point aside. Limbs of blocks
/// have corners at both ends only, and those at the joint point anywhere: through all skin, then.
/// @param middle  shares of the farthest skin
Vec3 direction_through(const std::vector<Vec3>& points, const Vec3& joint, const double (&middle)[2])
{
    double reach = 0;
    for (const Vec3& point : points)
        reach = std::max(reach, (point - joint).norm());
    Directions between, all;
    for (const Vec3& point : points) {
        const Vec3 way = point - joint;
        all.add(way);
        if (way.norm() > middle[0] * reach && way.norm() < middle[1] * reach)
            between.add(way);
    }
    return (between.agree() ? between : all).sum.normalized();
}

double extent_along(const std::vector<Vec3>& points, const Vec3& joint, const Vec3& direction)
{
    double extent = 0;
    for (const Vec3& point : points)
        extent = std::max(extent, (point - joint).dot(direction));
    return extent;
}

void add_joint(FileSkin& skin, NamedJoints& joints, const NamedJoint& joint, int parent, const Vec3& place)
{
    skin.nodes.push_back(-1);
    skin.names.emplace_back();
    skin.parents.push_back(parent);
    skin.places.push_back(place);
    skin.joint_from_world.emplace_back(Eigen::Translation3d(-place));
    joints.emplace_back(joint);
}

/// @param last  the joint before the missing one, @param above  the one before that
void add_end_of_limb(FileSkin& skin, NamedJoints& joints, JointKind above, JointKind last, const NamedJoint& missing)
{
    const int first = row_of(joints, above, missing.side), row = row_of(joints, last, missing.side);
    if (first < 0 || row < 0 || row_of(joints, missing.kind, missing.side) >= 0)
        return;
    const Vec3 joint = skin.places[std::size_t(row)];
    const double upper = (joint - skin.places[std::size_t(first)]).norm();
    const std::vector<Vec3> points = skin_of(skin, joints, row);
    const Vec3 direction = direction_through(points, joint, k_limb_middle);
    const double extent = extent_along(points, joint, direction);
    if (!(extent > 0))
        return;
    const double length = missing.kind == JointKind::ankle
        ? k_shin_to_sole * extent
        : std::clamp(k_forearm_to_upper_arm * upper, k_forearm_to_fingertip[0] * extent,
                     k_forearm_to_fingertip[1] * extent);
    add_joint(skin, joints, missing, row, joint + length * direction);
}

/// The kinds of the three joints of an arm or leg, and where the second and the third are usual.
struct LimbKinds {
    JointKind first, middle, last;
    double middle_share, last_share;  ///< of the way from the first joint to the end of the skin
};
constexpr LimbKinds k_arm { JointKind::shoulder, JointKind::elbow, JointKind::wrist, k_elbow_share, k_wrist_share };
constexpr LimbKinds k_leg { JointKind::hip, JointKind::knee, JointKind::ankle, k_knee_share, k_ankle_share };

bool is_below(const FileSkin& skin, int row, int ancestor)
{
    for (row = skin.parents[std::size_t(row)]; row >= 0; row = skin.parents[std::size_t(row)])
        if (row == ancestor)
            return true;
    return false;
}

/// The unnamed joint below `first` (and above `last`, if there is one) that is nearest to a share of the way along the
/// limb; -1: none is near.
int unnamed_joint_at(const FileSkin& skin, const NamedJoints& joints, int first, int last, const Vec3& whole,
                     double share)
{
    int best = -1;
    double least = k_near_share;
    for (int row = first + 1; row < int(joints.size()); ++row)
        if (named_from(skin, joints, row) == first && (last < 0 || is_below(skin, last, row))) {
            const Vec3 way = skin.places[std::size_t(row)] - skin.places[std::size_t(first)];
            if (const double off = (way / whole.norm() - share * whole.normalized()).norm(); off < least) {
                least = off;
                best = row;
            }
        }
    return best;
}

/// What hangs on `row` and lies beyond `place` hangs on `beyond`, with a smooth transition.
void divide_skin(FileSkin& skin, int row, int beyond, const Vec3& whole)
{
    const double reach = whole.norm();
    const Vec3& place = skin.places[std::size_t(beyond)];
    for (std::size_t v = 0; v < skin.hangs.size(); ++v) {
        const double along = (Vec3(skin.positions.row(Eigen::Index(v))) - place).dot(whole) / (reach * reach);
        const double share = std::clamp(0.5 + 0.5 * along / k_middle_blend, 0.0, 1.0);
        double moved = 0;
        for (auto& [joint, weight] : skin.hangs[v])
            if (joint == row) {
                moved += share * weight;
                weight *= 1 - share;
            }
        if (moved > 0)
            skin.hangs[v].emplace_back(beyond, moved);
    }
}

/// Whether the last joint lies where the middle of the limb is usual, with nothing between it and the first: the limb
/// has two bones, and the lower one is called a hand or foot.
bool is_middle_called_last(const FileSkin& skin, const NamedJoints& joints, const LimbKinds& limb, int side)
{
    const int first = row_of(joints, limb.first, side), last = row_of(joints, limb.last, side);
    if (first < 0 || last < 0 || skin.parents[std::size_t(last)] != first)
        return false;
    const Vec3 start = skin.places[std::size_t(first)], way = skin.places[std::size_t(last)] - start;
    const std::vector<Vec3> beyond = skin_of(skin, joints, last);
    return way.norm() > 0
        && way.norm() < k_middle_called_last * limb.last_share * extent_along(beyond, start, way.normalized());
}

/// "Arm.L" and "Hand.L", or "Leg.L" and "Foot.L", as figures of games have. On both sides, as what one hand holds is no
/// forearm.
void name_middles_called_last(const FileSkin& skin, NamedJoints& joints, const LimbKinds& limb)
{
    if (!is_middle_called_last(skin, joints, limb, 1) || !is_middle_called_last(skin, joints, limb, 2))
        return;
    for (const int side : { 1, 2 })
        joints[std::size_t(row_of(joints, limb.last, side))] = NamedJoint { limb.middle, side };
}

/// "thigh.L.001" is no second hip where no joint is called a knee.
void forget_repeated(NamedJoints& joints, int first)
{
    const NamedJoint name = *joints[std::size_t(first)];
    for (auto joint = joints.begin() + first + 1; joint != joints.end(); ++joint)
        if (*joint && (*joint)->kind == name.kind && (*joint)->side == name.side)
            joint->reset();
}

/// Names the knee or elbow of a limb of which only the first joint, or the first and the last, have known names: the
/// joint without a name where it is usual; where there is none, as the limb is one bone, it is added.
void add_middle_of_limb(FileSkin& skin, NamedJoints& joints, const LimbKinds& limb, int side)
{
    const int first = row_of(joints, limb.first, side), last = row_of(joints, limb.last, side);
    if (first < 0 || row_of(joints, limb.middle, side) >= 0)
        return;
    forget_repeated(joints, first);
    const Vec3 start = skin.places[std::size_t(first)];
    Vec3 whole;
    if (last >= 0) {
        whole = (skin.places[std::size_t(last)] - start) / limb.last_share;
    } else {
        const std::vector<Vec3> points = skin_of(skin, joints, first);
        const Vec3 direction = direction_through(points, start, k_lower_limb);
        whole = extent_along(points, start, direction) * direction;
    }
    if (!(whole.norm() > 0))
        return;
    int middle = unnamed_joint_at(skin, joints, first, last, whole, limb.middle_share);
    if (middle < 0) {
        middle = int(joints.size());
        add_joint(skin, joints, { limb.middle, side }, first, start + limb.middle_share * whole);
        divide_skin(skin, first, middle, whole);
        if (last < 0)  // the limb is one bone, so straight
            add_joint(skin, joints, { limb.last, side }, middle, start + limb.last_share * whole);
        return;
    }
    joints[std::size_t(middle)] = NamedJoint { limb.middle, side };
    if (last >= 0)
        return;
    if (const int end = unnamed_joint_at(skin, joints, middle, -1, whole, limb.last_share - limb.middle_share);
        end >= 0)
        joints[std::size_t(end)] = NamedJoint { limb.last, side };
}

void add_head(FileSkin& skin, NamedJoints& joints)
{
    const int pelvis = row_of(joints, JointKind::pelvis, 0), neck = row_of(joints, JointKind::neck, 0);
    if (pelvis < 0 || neck < 0 || row_of(joints, JointKind::head, 0) >= 0)
        return;
    const Vec3 joint = skin.places[std::size_t(neck)];
    const Vec3 up = (joint - skin.places[std::size_t(pelvis)]).normalized();
    if (const double extent = extent_along(skin_of(skin, joints, neck), joint, up); extent > 0)
        add_joint(skin, joints, { JointKind::head, 0 }, neck, joint + k_neck_to_crown * extent * up);
}

}  // namespace

int row_of(const NamedJoints& joints, JointKind kind, int side)
{
    for (std::size_t j = 0; j < joints.size(); ++j)
        if (joints[j] && joints[j]->kind == kind && joints[j]->side == side && !joints[j]->is_later_part)
            return int(j);
    return -1;
}

void add_missing_joints(FileSkin& skin, NamedJoints& joints)
{
    for (const LimbKinds& limb : { k_arm, k_leg })
        name_middles_called_last(skin, joints, limb);
    for (const int side : { 1, 2 }) {
        add_middle_of_limb(skin, joints, k_arm, side);
        add_middle_of_limb(skin, joints, k_leg, side);
        add_end_of_limb(skin, joints, JointKind::shoulder, JointKind::elbow, { JointKind::wrist, side });
        add_end_of_limb(skin, joints, JointKind::hip, JointKind::knee, { JointKind::ankle, side });
    }
    add_head(skin, joints);
}

}  // namespace garmentfit
