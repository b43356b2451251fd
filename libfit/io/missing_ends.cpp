// SPDX-License-Identifier: GPL-3.0-or-later
#include "missing_ends.h"

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

/// What mostly hangs on a joint, or on those below it that have no names.
std::vector<Vec3> skin_of(const FileSkin& skin, const NamedJoints& joints, int row)
{
    std::vector<Vec3> points;
    for (std::size_t v = 0; v < skin.hangs.size(); ++v) {
        double own = 0, all = 0;
        for (const auto& [joint, weight] : skin.hangs[v]) {
            all += weight;
            if (named_from(skin, joints, joint) == row)
                own += weight;
        }
        if (own > 0.5 * all)
            points.emplace_back(skin.positions.row(Eigen::Index(v)));
    }
    return points;
}

/// From a joint through the skin that lies neither at it nor at the end, as toes and thumbs point aside.
Vec3 direction_through(const std::vector<Vec3>& points, const Vec3& joint)
{
    double reach = 0;
    for (const Vec3& point : points)
        reach = std::max(reach, (point - joint).norm());
    Vec3 sum = Vec3::Zero();
    for (const Vec3& point : points)
        if (const double d = (point - joint).norm(); d > k_limb_middle[0] * reach && d < k_limb_middle[1] * reach)
            sum += point - joint;
    return sum.normalized();
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
    const Vec3 direction = direction_through(points, joint);
    const double extent = extent_along(points, joint, direction);
    if (!(extent > 0))
        return;
    const double length = missing.kind == JointKind::ankle
        ? k_shin_to_sole * extent
        : std::clamp(k_forearm_to_upper_arm * upper, k_forearm_to_fingertip[0] * extent,
                     k_forearm_to_fingertip[1] * extent);
    add_joint(skin, joints, missing, row, joint + length * direction);
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
        if (joints[j] && joints[j]->kind == kind && joints[j]->side == side)
            return int(j);
    return -1;
}

void add_missing_ends(FileSkin& skin, NamedJoints& joints)
{
    for (const int side : { 1, 2 }) {
        add_end_of_limb(skin, joints, JointKind::shoulder, JointKind::elbow, { JointKind::wrist, side });
        add_end_of_limb(skin, joints, JointKind::hip, JointKind::knee, { JointKind::ankle, side });
    }
    add_head(skin, joints);
}

}  // namespace garmentfit
