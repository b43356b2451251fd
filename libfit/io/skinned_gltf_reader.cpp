// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "garmentfit/error.h"
#include "garmentfit/skinned_gltf.h"
#include "gltf_skin.h"
#include "gltf_unpack.h"
#include "joint_names.h"
#include "joints_by_tree.h"
#include "missing_joints.h"
#include "tuning.h"

namespace garmentfit {
namespace {

using nlohmann::ordered_json;

constexpr int k_pelvis = -1;  // unit: a mark that is no bone
constexpr std::array k_limb_bones { std::array { lclavicle, rclavicle }, std::array { lhumerus, rhumerus },
                                    std::array { lradius, rradius } };

/// What a member of a member ... is; null where there is none.
const ordered_json& at(const ordered_json& json, std::initializer_list<const char*> path)
{
    static const ordered_json none;
    const ordered_json* found = &json;
    for (const char* member : path) {
        if (!found->is_object() || !found->contains(member))
            return none;
        found = &(*found)[member];
    }
    return *found;
}

/// The nodes of a VRM avatar, 0.x or 1.0, by what it says that they are. Empty for other files.
std::map<int, std::string> vrm_names(const ordered_json& json)
{
    std::map<int, std::string> names;
    for (const ordered_json& bone : at(json, { "extensions", "VRM", "humanoid", "humanBones" }))
        if (at(bone, { "node" }).is_number_integer() && at(bone, { "bone" }).is_string())
            names.emplace(bone["node"].get<int>(), bone["bone"].get<std::string>());
    const ordered_json& bones = at(json, { "extensions", "VRMC_vrm", "humanoid", "humanBones" });
    if (bones.is_object())
        for (const auto& [name, bone] : bones.items())
            if (at(bone, { "node" }).is_number_integer())
                names.emplace(bone["node"].get<int>(), name);
    return names;
}

/// What a VRM avatar says itself takes the place of names.
FileSkin name_by_vrm(FileSkin skin, const ordered_json& json)
{
    const std::map<int, std::string> names = vrm_names(json);
    for (std::size_t j = 0; j < skin.names.size() && !names.empty(); ++j) {
        const auto found = names.find(skin.nodes[j]);
        skin.names[j] = found == names.end() ? std::string() : found->second;
    }
    return skin;
}

bool has_all_joints(const NamedJoints& joints)
{
    bool all = row_of(joints, JointKind::pelvis, 0) >= 0 && row_of(joints, JointKind::head, 0) >= 0;
    for (const JointKind kind :
         { JointKind::hip, JointKind::knee, JointKind::ankle, JointKind::shoulder, JointKind::elbow, JointKind::wrist })
        all = all && row_of(joints, kind, 1) >= 0 && row_of(joints, kind, 2) >= 0;
    return all;
}

/// The joints that the skin has, and, where their names lack some that nodes below them have, these nodes, too.
FileSkin read_named_skin(const FileBytes& file, const tinygltf::Model& model, const ordered_json& json)
{
    FileSkin skin = name_by_vrm(read_skin(file, model), json);
    if (has_all_joints(recognize_joints(skin.names)))
        return skin;
    FileSkin with_nodes = name_by_vrm(read_skin(file, model, NodesBelow::taken), json);
    return has_all_joints(recognize_joints(with_nodes.names)) ? with_nodes : skin;
}

UnnamedJoints unnamed(const FileSkin& skin)
{
    UnnamedJoints joints { skin.parents, skin.places, std::vector<double>(skin.places.size(), 0),
                           std::vector<Vec3>(skin.places.size(), Vec3::Zero()) };
    for (std::size_t v = 0; v < skin.hangs.size(); ++v)
        for (const auto& [joint, weight] : skin.hangs[v])
            if (positive(weight) > 0 && skin.positions.row(Eigen::Index(v)).allFinite()) {
                joints.masses[std::size_t(joint)] += weight;
                joints.centres[std::size_t(joint)] += weight * Vec3(skin.positions.row(Eigen::Index(v)));
            }
    for (std::size_t j = 0; j < joints.masses.size(); ++j)
        if (joints.masses[j] > 0)
            joints.centres[j] /= joints.masses[j];
    return joints;
}

/// Finds the bones of Skeleton among the joints of another rig.
class Translation {
public:
    Translation(const FileBytes& file, FileSkin skin) :
        file_(file), skin_(std::move(skin)), joints_(recognize_joints(skin_.names))
    {
        if (has_all_joints(joints_))
            return;
        if (auto joints = joints_by_tree(unnamed(skin_)); !joints.empty()) {
            joints_ = std::move(joints);
            by_tree_ = true;
        } else {
            add_missing_joints(skin_, joints_);
        }
    }

    ForeignRig rig()
    {
        place_limbs();
        place_spine();
        place_tips();
        ForeignRig result { skeleton_, {}, int(skin_.loose.size()), by_tree_, count_unnormalized(skin_) };
        std::vector<int> bones;  // k_pelvis for a joint that is none of the bones
        for (std::size_t j = 0; j < skin_.names.size(); ++j)
            bones.push_back(bone_for(int(j)));
        const auto n = Eigen::Index(skin_.hangs.size());
        result.weights.bones.resize(n, 4);
        result.weights.weights.resize(n, 4);
        for (Eigen::Index v = 0; v < n; ++v)
            hang(v, bones, result.weights);
        return result;
    }

private:
    /// The first joint of that kind, parents first; null: none.
    const Vec3* find(JointKind kind, int side) const
    {
        const int row = row_of(joints_, kind, side);
        return row < 0 ? nullptr : &skin_.places[std::size_t(row)];
    }

    /// @throws InvalidInput where there is none.
    const Vec3& place(JointKind kind, int side, const char* what) const
    {
        if (const Vec3* found = find(kind, side))
            return *found;
        file_.fail(std::string("has no joint with a known name for the ")
                   + (side == 0       ? ""
                          : side == 1 ? "left "
                                      : "right ")
                   + what
                   + ", and its joints are no human's by their places; name joints as Mixamo does: Hips, Neck, Head, "
                     "LeftArm, LeftForeArm, LeftHand, LeftUpLeg, "
                     "LeftLeg, LeftFoot");
    }

    void place_limbs()
    {
        for (const int side : { 0, 1 }) {
            skeleton_.tails[side ? rhipjoint : lhipjoint] = place(JointKind::hip, side + 1, "hip");
            skeleton_.tails[side ? rfemur : lfemur] = place(JointKind::knee, side + 1, "knee");
            skeleton_.tails[side ? rtibia : ltibia] = place(JointKind::ankle, side + 1, "ankle");
            skeleton_.tails[side ? rclavicle : lclavicle] = place(JointKind::shoulder, side + 1, "shoulder");
            skeleton_.tails[side ? rhumerus : lhumerus] = place(JointKind::elbow, side + 1, "elbow");
            skeleton_.tails[side ? rradius : lradius] = place(JointKind::wrist, side + 1, "wrist");
        }
        const Vec3* pelvis = find(JointKind::pelvis, 0);  // some figures hang their legs on the chest or on nothing
        skeleton_.root = pelvis ? *pelvis : Vec3(0.5 * (skeleton_.tail(lhipjoint) + skeleton_.tail(rhipjoint)));
    }

    /// Rigs have one to five joints in the spine and one or two in the neck. Those of Skeleton are placed evenly
    /// between the ends.
    void place_spine()
    {
        const Vec3& head = place(JointKind::head, 0, "head");
        const Vec3* found = find(JointKind::neck, 0);
        const Vec3 neck = found ? *found : neck_below(head);
        skeleton_.tails[thorax] = neck;
        raise_pelvis();
        skeleton_.tails[upperneck] = head;
        skeleton_.tails[lowerback] = skeleton_.root + (neck - skeleton_.root) / 3;
        skeleton_.tails[upperback] = skeleton_.root + (neck - skeleton_.root) * 2 / 3;
        skeleton_.tails[lowerneck] = 0.5 * (neck + head);
        for (std::size_t j = 0; j < skin_.names.size() && !by_tree_;
             ++j)  // in a rig that this library wrote, joints are the heads of bones
            if (const int b = bone_of(skin_.names[j]); b == upperback || b == thorax || b == upperneck)
                skeleton_.tails[parent_of(b)] = skin_.places[j];
    }

    /// Some figures have it in the crotch or below. Between the legs of trousers there would be no way for its bones.
    void raise_pelvis()
    {
        const Vec3 between_hips = 0.5 * (skeleton_.tail(lhipjoint) + skeleton_.tail(rhipjoint));
        const Vec3 trunk = skeleton_.tail(thorax) - between_hips;
        const double share = (skeleton_.root - between_hips).dot(trunk) / trunk.squaredNorm();
        if (share >= 0)
            return;
        skeleton_.root -= share * trunk;
        const Vec3 across = (skeleton_.tail(lhipjoint) - skeleton_.tail(rhipjoint)).normalized();
        skeleton_.root -= (skeleton_.root - between_hips).dot(across) * across;  // the scene's node may lie anywhere
    }

    /// Where a head hangs on the trunk, from the shoulders on.
    Vec3 neck_below(const Vec3& head) const
    {
        const Vec3 shoulders = 0.5 * (skeleton_.tail(lclavicle) + skeleton_.tail(rclavicle)),
                   axis = head - skeleton_.root;
        const double t = std::clamp((shoulders - skeleton_.root).dot(axis) / axis.squaredNorm(), 0.0, 1.0);
        return head - k_neck_above_shoulders * (1 - t) * axis;
    }

    /// The joint farthest beyond the last one, toes and fingertips included; half a bone beyond where there is none.
    void place_tips()
    {
        for (int e = 0; e < extremity_count; ++e) {
            const int bone = bone_before(Extremity(e));
            const Vec3& last = skeleton_.tail(bone);
            skeleton_.tips[e] = last + 0.5 * (last - skeleton_.head(bone));
            double farthest = 0;
            for (std::size_t j = 0; j < joints_.size(); ++j)
                if (const double d = (skin_.places[j] - last).norm();
                    d > farthest && skin_.places[j] != last && bone_for(int(j)) == bone && !joints_[j]) {
                    farthest = d;
                    skeleton_.tips[e] = skin_.places[j];
                }
        }
    }

    int bone_of_joint(const NamedJoint& joint, const Vec3& place) const
    {
        const bool right = joint.side == 2;
        switch (joint.kind) {
        case JointKind::pelvis: return k_pelvis;
        case JointKind::spine: return nearest_of_spine(place);
        case JointKind::neck: return lowerneck;
        case JointKind::head: return upperneck;
        case JointKind::clavicle: return k_limb_bones[0][right];
        case JointKind::shoulder: return k_limb_bones[1][right];
        case JointKind::elbow:
        case JointKind::wrist: return k_limb_bones[2][right];
        case JointKind::hip: return right ? rfemur : lfemur;
        default: return right ? rtibia : ltibia;
        }
    }

    int nearest_of_spine(const Vec3& place) const
    {
        const Vec3 axis = skeleton_.tail(thorax) - skeleton_.root;
        const double t = (place - skeleton_.root).dot(axis) / axis.squaredNorm();
        return t < 1.0 / 3 ? lowerback : t < 2.0 / 3 ? upperback : thorax;
    }

    /// The bone of a joint, or of the nearest joint above it that has a known name.
    int bone_for(int joint) const
    {
        for (; joint >= 0; joint = skin_.parents[std::size_t(joint)])
            if (const int b = by_tree_ ? -1 : bone_of(skin_.names[std::size_t(joint)]); b >= 0)
                return b;
            else if (joints_[std::size_t(joint)])
                return bone_of_joint(*joints_[std::size_t(joint)], skin_.places[std::size_t(joint)]);
        return k_pelvis;
    }

    /// The pelvis has no bone of its own. Its weight is divided between both hip joints.
    void hang(Eigen::Index v, const std::vector<int>& bones, SkinWeights& weights) const
    {
        std::array<std::pair<double, int>, bone_count> sums;
        for (int b = 0; b < bone_count; ++b)
            sums[std::size_t(b)] = { 0, b };
        for (const auto& [joint, weight] : skin_.hangs[std::size_t(v)])
            if (const int b = bones[std::size_t(joint)]; b == k_pelvis) {
                sums[lhipjoint].first += 0.5 * positive(weight);
                sums[rhipjoint].first += 0.5 * positive(weight);
            } else {
                sums[std::size_t(b)].first += positive(weight);
            }
        std::stable_sort(sums.begin(), sums.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
        const double total = sums[0].first + sums[1].first + sums[2].first + sums[3].first;
        for (int k = 0; k < 4; ++k) {
            weights.bones(v, k) = sums[std::size_t(k)].second;
            weights.weights(v, k) = sums[std::size_t(k)].first / total;
        }
    }

    const FileBytes& file_;
    FileSkin skin_;
    NamedJoints joints_;
    bool by_tree_ = false;  ///< the names said nothing
    Skeleton skeleton_;
};

}  // namespace

bool has_skin(const std::filesystem::path& path)
{
    const FileBytes file = read_file(path);
    const tinygltf::Model model = load_model(file, read_plain_gltf(file, path.parent_path()), path.parent_path());
    return std::any_of(model.nodes.begin(), model.nodes.end(),
                       [](const tinygltf::Node& node) { return node.mesh >= 0 && node.skin >= 0; });
}

bool has_skeleton(const std::filesystem::path& path)
{
    const FileBytes file = read_file(path);
    return shows_skeleton(file, load_model(file, read_plain_gltf(file, path.parent_path()), path.parent_path()));
}

ForeignRig read_skinned_gltf(const std::filesystem::path& path)
{
    const FileBytes file = read_file(path);
    const GltfContainer container = read_plain_gltf(file, path.parent_path());
    const tinygltf::Model model = load_model(file, container, path.parent_path());
    return Translation(file, read_named_skin(file, model, container.json)).rig();
}

}  // namespace garmentfit
