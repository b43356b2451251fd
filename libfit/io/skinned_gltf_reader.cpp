// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "garmentfit/error.h"
#include "garmentfit/skinned_gltf.h"
#include "gltf_model.h"
#include "gltf_scene.h"
#include "gltf_unpack.h"
#include "joint_names.h"
#include "nearest.h"

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
    std::vector<std::vector<std::pair<int, double>>> hangs;  ///< of each vertex: joints and weights
    int loose = 0;  ///< vertices that hung on no joint
};

bool has_weight(const std::vector<std::pair<int, double>>& hang)
{
    return std::any_of(hang.begin(), hang.end(),
                       [](const auto& joint) { return joint.second > 0 && std::isfinite(joint.second); });
}

// Hats beside the skeleton's tree, and vertices that an exporter left out of its weights, follow what they lie at.
// @throws InvalidInput where no vertex has a weight
void hang_on_nearest(const FileBytes& file, const Positions& positions, FileSkin& skin)
{
    std::vector<int> held, loose;
    for (std::size_t v = 0; v < skin.hangs.size(); ++v)
        (has_weight(skin.hangs[v]) ? held : loose).push_back(int(v));
    if (held.empty())
        file.fail("has a skin, but no vertex with a positive weight; export the weights, too");
    skin.loose = int(loose.size());
    if (loose.empty())
        return;
    const NearestPoint nearest(positions(held, Eigen::all));
    for (const int v : loose)
        skin.hangs[std::size_t(v)] = skin.hangs[std::size_t(held[std::size_t(nearest.index(positions.row(v)))])];
}

/// Reads all skins of a file as one: their joints are merged by node. The rows are the vertices of MeshFile.
class SkinReader {
public:
    SkinReader(const FileBytes& file, const tinygltf::Model& model) :
        file_(file), model_(model), scene_(file, model), row_of_(model.nodes.size(), -1)
    {
    }

    FileSkin read()
    {
        const std::vector<GltfSurface> surfaces = scene_.surfaces();
        for (const GltfSurface& surface : surfaces)
            add_joints(surface.node);
        if (skin_.names.empty())
            file_.fail("has no skinned mesh; give a rigged body");
        for (const int node : joints_)
            skin_.parents.push_back(joint_above(scene_.parent(node)));
        for (const GltfSurface& surface : surfaces)
            if (surface.adds_vertices)
                read_weights(surface);
        hang_on_nearest(file_, positions_of(surfaces), skin_);
        return std::move(skin_);
    }

private:
    const tinygltf::Skin* skin_of(int node) const
    {
        const int skin = model_.nodes[std::size_t(node)].skin;
        return skin < 0 ? nullptr : &checked(file_, model_.skins, skin, "skin");
    }

    void add_joints(int node)
    {
        const tinygltf::Skin* skin = skin_of(node);
        if (!skin)
            return;
        const Eigen::Affine3d world_from_mesh = scene_.world_from_mesh(node);
        for (std::size_t j = 0; j < skin->joints.size(); ++j) {
            const int joint = skin->joints[j];
            const std::string& name = checked(file_, model_.nodes, joint, "node").name;
            if (row_of_[std::size_t(joint)] >= 0)
                continue;
            row_of_[std::size_t(joint)] = int(joints_.size());
            joints_.push_back(joint);
            skin_.names.push_back(name);
            skin_.places.push_back((world_from_mesh * scene_.joint_from_mesh(*skin, j).inverse()).translation());
            if (!skin_.places.back().allFinite())
                file_.fail("joint '" + name + "' has no position; export the skin with its bind pose");
        }
    }

    /// The row of the node, or of the nearest one above it that is a joint; -1 where there is none.
    int joint_above(int node) const
    {
        while (node >= 0 && row_of_[std::size_t(node)] < 0)
            node = scene_.parent(node);
        return node < 0 ? -1 : row_of_[std::size_t(node)];
    }

    /// Eyes, hair and the like may be moved by a joint without a skin of their own.
    void read_weights(const GltfSurface& surface)
    {
        const std::size_t first = skin_.hangs.size();
        skin_.hangs.resize(first + surface.positions.count);
        if (const tinygltf::Skin* skin = skin_of(surface.node))
            for (int set = 0; read_set(surface, *skin, set, first);)
                ++set;
        else if (const int joint = joint_above(surface.node); joint >= 0)
            std::fill(skin_.hangs.begin() + std::ptrdiff_t(first), skin_.hangs.end(),
                      std::vector<std::pair<int, double>> { { joint, 1.0 } });
    }

    /// Where the scene shows the vertices of the file, in its units.
    Positions positions_of(const std::vector<GltfSurface>& surfaces) const
    {
        Positions result(Eigen::Index(skin_.hangs.size()), 3);
        Eigen::Index row = 0;
        for (const GltfSurface& surface : surfaces) {
            if (!surface.adds_vertices)
                continue;
            const Eigen::Affine3d world_from_mesh = scene_.world_from_mesh(surface.node);
            for (std::size_t v = 0; v < surface.positions.count; ++v) {
                const auto at = [&](int k) { return number_at(model_, surface.positions, v, k); };
                result.row(row++) = (world_from_mesh * Vec3(at(0), at(1), at(2))).transpose();
            }
        }
        return result;
    }

    int type_of(const Column& column) const { return model_.accessors[std::size_t(column.accessor)].componentType; }

    /// Four joints and weights of each vertex; further sets follow where the file has more.
    bool read_set(const GltfSurface& surface, const tinygltf::Skin& skin, int set, std::size_t first)
    {
        const std::string number = std::to_string(set), joints = "JOINTS_" + number, weights = "WEIGHTS_" + number;
        const auto joint_at = surface.primitive->attributes.find(joints),
                   weight_at = surface.primitive->attributes.find(weights), end = surface.primitive->attributes.end();
        if (joint_at == end || weight_at == end)
            return false;
        const Column joint = column_of(file_, model_, joint_at->second, joints.c_str()),
                     weight = column_of(file_, model_, weight_at->second, weights.c_str());
        const auto is_four = [&](const Column& column) {
            return model_.accessors[std::size_t(column.accessor)].type == TINYGLTF_TYPE_VEC4
                && column.count == surface.positions.count;
        };
        const int of_joints = type_of(joint), of_weights = type_of(weight);
        const bool are_right = (of_joints == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE
                                || of_joints == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT)
            && (of_weights == TINYGLTF_COMPONENT_TYPE_FLOAT || of_weights == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE
                || of_weights == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
        if (!are_right)
            file_.fail("has " + joints + " or " + weights
                       + " of a type that glTF does not allow for them; export the file again");
        if (!is_four(joint) || !is_four(weight))
            file_.fail("has " + joints + " and " + weights
                       + " that are not four numbers a vertex; export the file again");
        for (std::size_t v = 0; v < joint.count; ++v)
            for (int k = 0; k < 4; ++k) {
                const double index = number_at(model_, joint, v, k);
                if (!(index >= 0 && index < double(skin.joints.size())))
                    file_.fail("vertex " + std::to_string(v) + " refers to joint " + std::to_string(int(index)) + " of "
                               + std::to_string(skin.joints.size()) + "; export the file again");
                skin_.hangs[first + v].emplace_back(row_of_[std::size_t(skin.joints[std::size_t(index)])],
                                                    number_at(model_, weight, v, k));
            }
        return true;
    }

    const FileBytes& file_;
    const tinygltf::Model& model_;
    const GltfScene scene_;
    std::vector<int> row_of_;  // of each node its row among the joints, -1 for others
    std::vector<int> joints_;  // nodes
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
        ForeignRig result { skeleton_, {}, skin_.loose };
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
        if (!std::isfinite(total))
            file_.fail("vertex " + std::to_string(v) + " has a weight without a limit; export the weights again");
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

bool has_skin(const std::filesystem::path& path)
{
    const FileBytes file = read_file(path);
    const tinygltf::Model model = load_model(file, read_plain_gltf(file, path.parent_path()), path.parent_path());
    return std::any_of(model.nodes.begin(), model.nodes.end(),
                       [](const tinygltf::Node& node) { return node.mesh >= 0 && node.skin >= 0; });
}

ForeignRig read_skinned_gltf(const std::filesystem::path& path)
{
    const FileBytes file = read_file(path);
    const tinygltf::Model model = load_model(file, read_plain_gltf(file, path.parent_path()), path.parent_path());
    const FileSkin skin = SkinReader(file, model).read();
    return Translation(file, skin).rig();
}

}  // namespace garmentfit
