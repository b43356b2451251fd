// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/filters/joint_names.h"

#include <string>

#include "garmentfit/error.h"

namespace garmentfit {
namespace {

constexpr std::string_view k_joint_names[bone_count]
    = { "lhip",     "lknee", "lankle",    "rhip",   "rknee",  "rankle",    "lower_spine", "upper_spine", "neck",
        "mid_neck", "skull", "lshoulder", "lelbow", "lwrist", "rshoulder", "relbow",      "rwrist" };
constexpr std::string_view k_tip_names[extremity_count]
    = { "head_top", "lhand_tip", "rhand_tip", "lfoot_tip", "rfoot_tip" };

}  // namespace

std::string_view joint_name(Bone bone) { return k_joint_names[bone]; }
std::string_view joint_name(Extremity tip) { return k_tip_names[tip]; }

std::optional<Vec3>& joint_of(GivenJoints& joints, std::string_view name)
{
    std::string names = "root";
    for (int b = 0; b < bone_count; names += ", " + std::string(k_joint_names[b++]))
        if (name == k_joint_names[b])
            return joints.tails[b];
    for (int e = 0; e < extremity_count; names += ", " + std::string(k_tip_names[e++]))
        if (name == k_tip_names[e])
            return joints.tips[e];
    if (name != "root")
        throw InvalidInput(ErrorCode::unknown_name,
                           "no joint is called \"" + std::string(name) + "\"; give one of " + names);
    return joints.root;
}

}  // namespace garmentfit
