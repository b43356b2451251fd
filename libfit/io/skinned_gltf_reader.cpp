// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <set>

#include "garmentfit/error.h"
#include "garmentfit/skinned_gltf.h"
#include "gltf_model.h"
#include "joint_names.h"

namespace garmentfit {
namespace {

constexpr int k_pelvis = -1;  // unit: a mark that is no bone
constexpr std::array k_limb_bones { std::array { lclavicle, rclavicle }, std::array { lhumerus, rhumerus },
                                    std::array { lradius, rradius } };

/// The skin as it is in the file.
struct FileSkin {
    std::vector<std::string> names;
    std::vector<int> parents;  ///< rows of the same; -1 none
    std::vector<Vec3> places;
    std::vector<std::array<std::pair<int, double>, 4>> hangs;  ///< of each vertex: joint and weight
};

double number_at(const tinygltf::Model& model, const Column& column, std::size_t row, int k)
{
    const tinygltf::Accessor& accessor = model.accessors[std::size_t(column.accessor)];
    const auto* at = model.buffers[std::size_t(column.buffer)].data.data() + column.offset(Eigen::Index(row))
        + std::size_t(k) * std::size_t(tinygltf::GetComponentSizeInBytes(accessor.componentType));
    const auto read = [&](auto number) {
        std::memcpy(&number, at, sizeof number);
        return accessor.normalized ? double(number) / double(std::numeric_limits<decltype(number)>::max())
                                   : double(number);
    };
    switch (accessor.componentType) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return read(std::uint8_t());
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return read(std::uint16_t());
    default: {
        float number;
        std::memcpy(&number, at, sizeof number);
        return number;
    }
    }
}

class SkinReader {
public:
    SkinReader(const FileBytes& file, const tinygltf::Model& model) : file_(file), model_(model) { }

    FileSkin read()
    {
        const auto body = std::find_if(model_.nodes.begin(), model_.nodes.end(),
                                       [](const tinygltf::Node& node) { return node.mesh >= 0 && node.skin >= 0; });
        if (body == model_.nodes.end())
            file_.fail("has no skinned mesh; give a rigged body");
        read_joints(checked(file_, model_.skins, body->skin, "skin"));
        std::set<int> seen;  // primitives may share vertices
        for (const tinygltf::Primitive& primitive : checked(file_, model_.meshes, body->mesh, "mesh").primitives)
            if (const auto position = primitive.attributes.find("POSITION");
                position != primitive.attributes.end() && seen.insert(position->second).second)
                read_weights(primitive);
        return std::move(skin_);
    }

private:
    void read_joints(const tinygltf::Skin& skin)
    {
        const Column binds = column_of(file_, model_, skin.inverseBindMatrices, "inverseBindMatrices");
        const tinygltf::Accessor& accessor = model_.accessors[std::size_t(binds.accessor)];
        if (accessor.type != TINYGLTF_TYPE_MAT4 || accessor.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT
            || binds.count < skin.joints.size())
            file_.fail("has no inverse bind matrix for each joint; export the skin with its bind pose");
        for (std::size_t j = 0; j < skin.joints.size(); ++j) {
            skin_.names.push_back(checked(file_, model_.nodes, skin.joints[j], "node").name);
            Eigen::Matrix4d bind;
            for (int k = 0; k < 16; ++k)
                bind(k % 4, k / 4) = number_at(model_, binds, j, k);
            skin_.places.push_back(bind.inverse().topRightCorner<3, 1>());
            if (!skin_.places.back().allFinite())
                file_.fail("joint '" + skin_.names.back() + "' has no position; export the skin with its bind pose");
        }
        for (const int joint : skin.joints)
            skin_.parents.push_back(parent_row(skin, joint));
    }

    int parent_row(const tinygltf::Skin& skin, int node) const
    {
        for (std::size_t j = 0; j < skin.joints.size(); ++j) {
            const std::vector<int>& children = model_.nodes[std::size_t(skin.joints[j])].children;
            if (std::find(children.begin(), children.end(), node) != children.end())
                return int(j);
        }
        return -1;
    }

    void read_weights(const tinygltf::Primitive& primitive)
    {
        const auto joints = primitive.attributes.find("JOINTS_0"), weights = primitive.attributes.find("WEIGHTS_0");
        if (joints == primitive.attributes.end() || weights == primitive.attributes.end())
            file_.fail("has vertices without JOINTS_0 and WEIGHTS_0; give a rigged body");
        const Column joint = column_of(file_, model_, joints->second, "JOINTS_0"),
                     weight = column_of(file_, model_, weights->second, "WEIGHTS_0");
        if (model_.accessors[std::size_t(joint.accessor)].type != TINYGLTF_TYPE_VEC4
            || model_.accessors[std::size_t(weight.accessor)].type != TINYGLTF_TYPE_VEC4 || joint.count != weight.count)
            file_.fail("has JOINTS_0 and WEIGHTS_0 that are not four numbers a vertex; export the file again");
        for (std::size_t v = 0; v < joint.count; ++v) {
            auto& hang = skin_.hangs.emplace_back();
            for (int k = 0; k < 4; ++k) {
                hang[std::size_t(k)] = { int(number_at(model_, joint, v, k)), number_at(model_, weight, v, k) };
                if (hang[std::size_t(k)].first >= int(skin_.names.size()))
                    file_.fail("vertex " + std::to_string(v) + " refers to joint "
                               + std::to_string(hang[std::size_t(k)].first) + " of "
                               + std::to_string(skin_.names.size()) + "; export the file again");
            }
        }
    }

    const FileBytes& file_;
    const tinygltf::Model& model_;
    FileSkin skin_;
};

/// Finds the bones of Skeleton among the joints of another rig.
class Translation {
public:
    Translation(const FileBytes& file, const FileSkin& skin) :
        file_(file), skin_(skin), joints_(recognize_joints(skin.names))
    {
    }

    ForeignRig rig()
    {
        place_limbs();
        place_spine();
        place_tips();
        ForeignRig result { skeleton_, {} };
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
    /// The first joint of that kind, parents first. @throws InvalidInput.
    const Vec3& place(JointKind kind, int side, const char* what) const
    {
        for (std::size_t j = 0; j < joints_.size(); ++j)
            if (joints_[j] && joints_[j]->kind == kind && joints_[j]->side == side)
                return skin_.places[j];
        file_.fail(std::string("has no joint with a known name for the ")
                   + (side == 0       ? ""
                          : side == 1 ? "left "
                                      : "right ")
                   + what
                   + "; name joints as Mixamo does: Hips, Neck, Head, LeftArm, LeftForeArm, LeftHand, LeftUpLeg, "
                     "LeftLeg, LeftFoot");
    }

    void place_limbs()
    {
        skeleton_.root = place(JointKind::pelvis, 0, "pelvis");
        for (const int side : { 0, 1 }) {
            skeleton_.tails[side ? rhipjoint : lhipjoint] = place(JointKind::hip, side + 1, "hip");
            skeleton_.tails[side ? rfemur : lfemur] = place(JointKind::knee, side + 1, "knee");
            skeleton_.tails[side ? rtibia : ltibia] = place(JointKind::ankle, side + 1, "ankle");
            skeleton_.tails[side ? rclavicle : lclavicle] = place(JointKind::shoulder, side + 1, "shoulder");
            skeleton_.tails[side ? rhumerus : lhumerus] = place(JointKind::elbow, side + 1, "elbow");
            skeleton_.tails[side ? rradius : lradius] = place(JointKind::wrist, side + 1, "wrist");
        }
    }

    /// Rigs have one to five joints in the spine and one or two in the neck. Those of Skeleton are placed evenly
    /// between the ends.
    void place_spine()
    {
        const Vec3& neck = place(JointKind::neck, 0, "neck");
        const Vec3& head = place(JointKind::head, 0, "head");
        skeleton_.tails[thorax] = neck;
        skeleton_.tails[upperneck] = head;
        skeleton_.tails[lowerback] = skeleton_.root + (neck - skeleton_.root) / 3;
        skeleton_.tails[upperback] = skeleton_.root + (neck - skeleton_.root) * 2 / 3;
        skeleton_.tails[lowerneck] = 0.5 * (neck + head);
        for (std::size_t j = 0; j < skin_.names.size();
             ++j)  // in a rig that this library wrote, joints are the heads of bones
            if (const int b = bone_of(skin_.names[j]); b == upperback || b == thorax || b == upperneck)
                skeleton_.tails[parent_of(b)] = skin_.places[j];
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
        for (std::size_t steps = 0; joint >= 0 && steps <= joints_.size();
             ++steps, joint = skin_.parents[std::size_t(joint)])
            if (const int b = bone_of(skin_.names[std::size_t(joint)]); b >= 0)
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
                sums[lhipjoint].first += 0.5 * std::max(weight, 0.0);
                sums[rhipjoint].first += 0.5 * std::max(weight, 0.0);
            } else {
                sums[std::size_t(b)].first += std::max(weight, 0.0);
            }
        std::stable_sort(sums.begin(), sums.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
        const double total = sums[0].first + sums[1].first + sums[2].first + sums[3].first;
        if (!(total > 0) || !std::isfinite(total))
            file_.fail("vertex " + std::to_string(v) + " has no positive weight; normalise the weights");
        for (int k = 0; k < 4; ++k) {
            weights.bones(v, k) = sums[std::size_t(k)].second;
            weights.weights(v, k) = sums[std::size_t(k)].first / total;
        }
    }

    const FileBytes& file_;
    const FileSkin& skin_;
    std::vector<std::optional<NamedJoint>> joints_;
    Skeleton skeleton_;
};

}  // namespace

ForeignRig read_skinned_gltf(const std::filesystem::path& path)
{
    const FileBytes file = read_file(path);
    const tinygltf::Model model = load_model(file, read_gltf_container(file), path.parent_path());
    const FileSkin skin = SkinReader(file, model).read();
    return Translation(file, skin).rig();
}

}  // namespace garmentfit
