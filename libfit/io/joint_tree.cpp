// SPDX-License-Identifier: GPL-3.0-or-later
#include "joint_tree.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tuning.h"

namespace garmentfit {
namespace {

using Sides = std::array<const char*, 2>;  // left, right

/// What one program calls the joints; null: it has none. Bones without a joint move with the one before them.
struct Scheme {
    const char* ground;  // a root on the floor, before the pelvis
    const char* pelvis;
    std::array<const char*, bone_count> bones;  // in the order of Bone
    const char* head;  // at the tail of the last bone, moves nothing
    Sides hands, knuckles, feet, toes;
    const char* head_top;
    Sides hand_tips, foot_tips;
    bool moves_extremities;  // whether the skin of hands and feet follows their joints
};

constexpr Scheme k_garmentfit {
    nullptr,
    "root",
    { "lhipjoint", "lfemur", "ltibia", "rhipjoint", "rfemur", "rtibia", "lowerback", "upperback", "thorax", "lowerneck",
      "upperneck", "lclavicle", "lhumerus", "lradius", "rclavicle", "rhumerus", "rradius" },
    "head",
    { "lhand", "rhand" },
    {},
    { "lfoot", "rfoot" },
    {},
    "head_top",
    { "lhand_tip", "rhand_tip" },
    { "lfoot_tip", "rfoot_tip" },
    false,
};
constexpr Scheme k_vrm {
    nullptr,
    "hips",
    { nullptr, "leftUpperLeg", "leftLowerLeg", nullptr, "rightUpperLeg", "rightLowerLeg", "spine", "chest",
      "upperChest", "neck", "head", "leftShoulder", "leftUpperArm", "leftLowerArm", "rightShoulder", "rightUpperArm",
      "rightLowerArm" },
    nullptr,
    { "leftHand", "rightHand" },
    {},
    { "leftFoot", "rightFoot" },
    { "leftToes", "rightToes" },
    nullptr,
    {},
    {},
    true,
};
constexpr Scheme k_mixamo {
    nullptr,
    "mixamorig:Hips",
    { nullptr, "mixamorig:LeftUpLeg", "mixamorig:LeftLeg", nullptr, "mixamorig:RightUpLeg", "mixamorig:RightLeg",
      "mixamorig:Spine", "mixamorig:Spine1", "mixamorig:Spine2", "mixamorig:Neck", "mixamorig:Head",
      "mixamorig:LeftShoulder", "mixamorig:LeftArm", "mixamorig:LeftForeArm", "mixamorig:RightShoulder",
      "mixamorig:RightArm", "mixamorig:RightForeArm" },
    nullptr,
    { "mixamorig:LeftHand", "mixamorig:RightHand" },
    {},
    { "mixamorig:LeftFoot", "mixamorig:RightFoot" },
    { "mixamorig:LeftToeBase", "mixamorig:RightToeBase" },
    "mixamorig:HeadTop_End",
    {},
    { "mixamorig:LeftToe_End", "mixamorig:RightToe_End" },
    true,
};
constexpr Scheme k_unreal {
    "root",
    "pelvis",
    { nullptr, "thigh_l", "calf_l", nullptr, "thigh_r", "calf_r", "spine_01", "spine_02", "spine_03", "neck_01", "head",
      "clavicle_l", "upperarm_l", "lowerarm_l", "clavicle_r", "upperarm_r", "lowerarm_r" },
    nullptr,
    { "hand_l", "hand_r" },
    {},
    { "foot_l", "foot_r" },
    { "ball_l", "ball_r" },
    nullptr,
    {},
    {},
    true,
};
constexpr Scheme k_smpl {
    nullptr,
    "pelvis",
    { nullptr, "left_hip", "left_knee", nullptr, "right_hip", "right_knee", "spine1", "spine2", "spine3", "neck",
      "head", "left_collar", "left_shoulder", "left_elbow", "right_collar", "right_shoulder", "right_elbow" },
    nullptr,
    { "left_wrist", "right_wrist" },
    { "left_hand", "right_hand" },
    { "left_ankle", "right_ankle" },
    { "left_foot", "right_foot" },
    nullptr,
    {},
    {},
    true,
};

const Scheme& scheme_of(BoneNames names)
{
    switch (names) {
    case BoneNames::vrm: return k_vrm;
    case BoneNames::mixamo: return k_mixamo;
    case BoneNames::unreal: return k_unreal;
    case BoneNames::smpl: return k_smpl;
    default: return k_garmentfit;
    }
}

double lowest(const Skeleton& skeleton)
{
    double y = skeleton.root.y();
    for (const Vec3& place : skeleton.tails)
        y = std::min(y, place.y());
    for (const Vec3& place : skeleton.tips)
        y = std::min(y, place.y());
    return y;
}

class TreeBuilder {
public:
    TreeBuilder(const Skeleton& skeleton, const Scheme& scheme) : skeleton_(skeleton), scheme_(scheme) { }

    JointTree build()
    {
        const Vec3& pelvis = skeleton_.root;
        const int ground = add(scheme_.ground, -1, { pelvis.x(), lowest(skeleton_), pelvis.z() });
        pelvis_ = add(scheme_.pelvis, ground, pelvis);
        for (int b = 0; b < bone_count; ++b) {
            const int parent = before(b);
            tree_.joint_of[std::size_t(b)] = scheme_.bones[std::size_t(b)]
                ? add(scheme_.bones[std::size_t(b)], parent, skeleton_.head(b), b)
                : parent;
        }
        add_ends();
        return std::move(tree_);
    }

private:
    /// Null names give the parent.
    int add(const char* name, int parent, const Vec3& place, int bone = -1)
    {
        if (!name)
            return parent;
        tree_.joints.push_back({ name, parent, place, bone });
        return int(tree_.joints.size()) - 1;
    }

    int before(int bone) const { return parent_of(bone) < 0 ? pelvis_ : tree_.joint_of[std::size_t(parent_of(bone))]; }

    int add_after(const char* name, Extremity extremity)
    {
        const int bone = bone_before(extremity);
        return add(name, tree_.joint_of[std::size_t(bone)], skeleton_.tail(bone), bone_count + int(extremity));
    }

    Vec3 along(Extremity extremity, double share) const
    {
        const Vec3& begin = skeleton_.tail(bone_before(extremity));
        return begin + share * (skeleton_.tips[std::size_t(extremity)] - begin);
    }

    void add_ends()
    {
        constexpr std::array<Extremity, 2> hands { lhand_tip, rhand_tip }, feet { lfoot_tip, rfoot_tip };
        std::array<int, extremity_count> last {};
        last[head_top] = add_after(scheme_.head, head_top);
        for (std::size_t side = 0; side < 2; ++side)
            last[hands[side]] = add_limb(hands[side], scheme_.hands[side]);
        for (std::size_t side = 0; side < 2; ++side)
            last[feet[side]] = add_limb(feet[side], scheme_.feet[side]);
        for (std::size_t side = 0; side < 2; ++side) {
            last[hands[side]] = add(scheme_.knuckles[side], last[hands[side]], along(hands[side], k_knuckles));
            last[feet[side]] = add(scheme_.toes[side], last[feet[side]], along(feet[side], k_ball_of_foot));
        }
        add(scheme_.head_top, last[head_top], along(head_top, 1));
        for (std::size_t side = 0; side < 2; ++side)
            add(scheme_.hand_tips[side], last[hands[side]], along(hands[side], 1));
        for (std::size_t side = 0; side < 2; ++side)
            add(scheme_.foot_tips[side], last[feet[side]], along(feet[side], 1));
    }

    int add_limb(Extremity extremity, const char* name)
    {
        const int row = add_after(name, extremity);
        if (scheme_.moves_extremities)
            tree_.extremities[extremity] = row;
        return row;
    }

    const Skeleton& skeleton_;
    const Scheme& scheme_;
    JointTree tree_;
    int pelvis_ = 0;
};

/// How much of the weight of the bone before a hand or foot is the extremity's: 0 before the joint, 1 beyond it.
double share_beyond(const Skeleton& skeleton, int bone, const Vec3& place)
{
    const double along = (place - skeleton.tail(bone)).dot(skeleton.direction(bone)) / skeleton.length(bone);
    const double t = std::clamp(0.5 + 0.5 * along / k_wrist_blend, 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

using Entry = std::pair<double, int>;  // weight, joint

void add_entry(std::vector<Entry>& entries, double weight, int joint)
{
    if (!(weight > 0))
        return;
    for (Entry& entry : entries)
        if (entry.second == joint) {
            entry.first += weight;
            return;
        }
    entries.emplace_back(weight, joint);
}

/// Room for the joints of each vertex. glTF has them in sets of four.
FileWeights no_weights(const JointWeights& weights)
{
    Eigen::Index most = 0;
    for (Eigen::Index v = 0; v < weights.rows(); ++v)
        most = std::max(most, Eigen::Index(weights.row(v).nonZeros()));
    FileWeights result;
    result.joints.setZero(weights.rows(), most > 4 ? 8 : 4);
    result.weights.setZero(weights.rows(), result.joints.cols());
    return result;
}

/// The largest ones of a vertex. Weights that are left out go to them.
void set_row(std::vector<Entry>& entries, Eigen::Index vertex, FileWeights& result)
{
    std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.first > b.first; });
    const std::size_t kept = std::min(entries.size(), std::size_t(result.joints.cols()));
    double left_out = 0;
    for (std::size_t k = kept; k < entries.size(); ++k)
        left_out += entries[k].first;
    for (std::size_t k = 0; k < kept; ++k) {
        result.joints(vertex, Eigen::Index(k)) = entries[k].second;
        result.weights(vertex, Eigen::Index(k)) = left_out > 0 ? entries[k].first / (1 - left_out) : entries[k].first;
    }
}

}  // namespace

int JointTree::row_named(const std::string& name) const
{
    for (std::size_t row = 0; row < joints.size(); ++row)
        if (joints[row].name == name)
            return int(row);
    return -1;
}

JointTree joint_tree(const Skeleton& skeleton, BoneNames names)
{
    return TreeBuilder(skeleton, scheme_of(names)).build();
}

FileWeights file_weights(const JointTree& tree, const Skeleton& skeleton, const Positions& positions,
                         const JointWeights& weights)
{
    std::array<int, bone_count> end_of {};
    end_of.fill(-1);
    for (int e = 0; e < extremity_count; ++e)
        end_of[std::size_t(bone_before(Extremity(e)))] = tree.extremities[std::size_t(e)];
    FileWeights result = no_weights(weights);
    std::vector<Entry> entries;
    for (Eigen::Index v = 0; v < positions.rows(); ++v) {
        entries.clear();
        for (JointWeights::InnerIterator entry(weights, v); entry; ++entry) {
            const int bone = int(entry.col()), end = end_of[std::size_t(bone)];
            const double weight = entry.value();
            const double beyond = end < 0 || !(weight > 0) ? 0 : share_beyond(skeleton, bone, positions.row(v));
            add_entry(entries, weight * (1 - beyond), tree.joint_of[std::size_t(bone)]);
            add_entry(entries, weight * beyond, end);
        }
        set_row(entries, v, result);
    }
    return result;
}

FileWeights file_weights(const JointWeights& weights, const std::vector<int>& joints)
{
    std::vector<int> row_of(std::size_t(weights.cols()), -1);
    for (std::size_t row = joints.size(); row-- > 0;)  // the first place of one that is listed twice
        row_of[std::size_t(joints[row])] = int(row);
    FileWeights result = no_weights(weights);
    std::vector<Entry> entries;
    for (Eigen::Index v = 0; v < weights.rows(); ++v) {
        entries.clear();
        for (JointWeights::InnerIterator entry(weights, v); entry; ++entry)
            if (const int row = row_of[std::size_t(entry.col())]; row >= 0)
                add_entry(entries, entry.value(), row);
        set_row(entries, v, result);
    }
    return result;
}

}  // namespace garmentfit
