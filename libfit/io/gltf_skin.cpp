// SPDX-License-Identifier: GPL-3.0-or-later
#include "gltf_skin.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "garmentfit/error.h"
#include "gltf_scene.h"
#include "nearest.h"

namespace garmentfit {
namespace {

bool has_weight(const std::vector<std::pair<int, double>>& hang)
{
    return std::any_of(hang.begin(), hang.end(), [](const auto& joint) { return positive(joint.second) > 0; });
}

// Hats beside the skeleton's tree, and vertices that an exporter left out of its weights, follow what they lie at.
// @throws InvalidInput where no vertex has a weight
void hang_on_nearest(const FileBytes& file, const Positions& positions, FileSkin& skin)
{
    std::vector<int> held;
    for (std::size_t v = 0; v < skin.hangs.size(); ++v)
        (has_weight(skin.hangs[v]) ? held : skin.loose).push_back(int(v));
    if (held.empty())
        file.fail("has a skin, but no vertex with a positive weight; export the weights, too");
    if (skin.loose.empty())
        return;
    const NearestPoint nearest(positions(held, Eigen::all));
    for (const int v : skin.loose)
        skin.hangs[std::size_t(v)] = skin.hangs[std::size_t(held[std::size_t(nearest.index(positions.row(v)))])];
}

class SkinReader {
public:
    SkinReader(const FileBytes& file, const tinygltf::Model& model) :
        file_(file), model_(model), scene_(file, model), joints_(model.nodes.size()), row_of_(model.nodes.size(), -1)
    {
    }

    FileSkin read(NodesBelow below)
    {
        const std::vector<GltfSurface> surfaces = scene_.surfaces();
        for (const GltfSurface& surface : surfaces)
            add_joints(surface.node);
        if (std::none_of(joints_.begin(), joints_.end(), [](const auto& joint) { return joint.has_value(); }))
            add_joints_of_rigid_parts();
        place_ends();
        add_nodes_between();
        if (below == NodesBelow::taken)
            add_nodes_below();
        list_joints();
        if (skin_.names.empty())
            file_.fail("has no skinned mesh; give a rigged body");
        for (const GltfSurface& surface : surfaces)
            if (surface.adds_vertices)
                read_weights(surface);
        skin_.positions = positions_of(surfaces);
        hang_on_nearest(file_, skin_.positions, skin_);
        return std::move(skin_);
    }

private:
    struct Joint {
        Eigen::Affine3d joint_from_world;
        Vec3 place;
        bool is_at_origin = false;  ///< of the mesh, in the bind pose
    };

    bool is_joint(int node) const { return joints_[std::size_t(node)].has_value(); }

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
        if (!scene_.has_bind_pose(*skin))
            file_.fail("has a skin whose inverse bind matrices are no transforms; export the skin with its bind pose");
        const Eigen::Affine3d world_from_mesh = scene_.world_from_mesh(node);
        for (std::size_t j = 0; j < skin->joints.size(); ++j) {
            const int joint = skin->joints[j];
            const std::string& name = checked(file_, model_.nodes, joint, "node").name;
            if (is_joint(joint))
                continue;
            const Eigen::Affine3d joint_from_mesh = scene_.joint_from_mesh(*skin, j);
            const Vec3 place = (world_from_mesh * joint_from_mesh.inverse()).translation();
            if (!place.allFinite())
                file_.fail("joint '" + name + "' has no position; export the skin with its bind pose");
            joints_[std::size_t(joint)]
                = { joint_from_mesh * world_from_mesh.inverse(), place, joint_from_mesh.translation().isZero(0) };
        }
    }

    /// Joints that end the tree and move nothing, such as "Head_end", have no bind pose in the files of some exporters:
    /// all lie at the origin.
    void place_ends()
    {
        std::vector<bool> has_joints_below(model_.nodes.size(), false);
        for (auto node = scene_.nodes().rbegin(); node != scene_.nodes().rend(); ++node)
            if (const int above = scene_.parent(*node);
                above >= 0 && (is_joint(*node) || has_joints_below[std::size_t(*node)]))
                has_joints_below[std::size_t(above)] = true;
        for (const int node : scene_.nodes())
            if (const int above = joint_from(scene_.parent(node)); above >= 0 && is_joint(node)
                && !has_joints_below[std::size_t(node)] && joints_[std::size_t(node)]->is_at_origin)
                add_weightless(node, above);
    }

    /// Where no mesh has a skin, the file's skins still say which nodes are joints. Parts of a figure that hang on them
    /// have no bind pose but the scene.
    void add_joints_of_rigid_parts()
    {
        for (const tinygltf::Skin& skin : model_.skins)
            for (const int joint : skin.joints) {
                checked(file_, model_.nodes, joint, "node");
                const Eigen::Affine3d world_from_joint = scene_.world_from_node(joint),
                                      joint_from_world = world_from_joint.inverse();
                if (joint_from_world.matrix().allFinite())  // else the scene shows it flat
                    joints_[std::size_t(joint)] = { joint_from_world, world_from_joint.translation() };
            }
    }

    /// Of each node its children in the scene that are joints or have some below them.
    std::vector<std::vector<int>> branches_with_joints() const
    {
        std::vector<std::vector<int>> branches(model_.nodes.size());
        for (auto node = scene_.nodes().rbegin(); node != scene_.nodes().rend(); ++node)
            if (const int above = scene_.parent(*node);
                above >= 0 && (is_joint(*node) || !branches[std::size_t(*node)].empty()))
                branches[std::size_t(above)].push_back(*node);
        return branches;
    }

    /// From the lowest node that all joints lie at or below.
    void add_nodes_between()
    {
        const std::vector<std::vector<int>> branches = branches_with_joints();
        std::vector<bool> is_inner(model_.nodes.size(), false);
        for (const int node : scene_.nodes()) {  // parents first
            const int above = scene_.parent(node);
            const bool has_inner_above = above >= 0 && is_inner[std::size_t(above)];
            is_inner[std::size_t(node)] = is_joint(node) || has_inner_above || branches[std::size_t(node)].size() > 1;
            if (is_inner[std::size_t(node)] && !is_joint(node) && !branches[std::size_t(node)].empty())
                add_weightless(node, joint_near(node, branches));
        }
    }

    /// A mesh is no joint, whatever its name.
    void add_nodes_below()
    {
        for (const int node : scene_.nodes())  // parents first
            if (const int above = joint_from(scene_.parent(node));
                above >= 0 && !is_joint(node) && model_.nodes[std::size_t(node)].mesh < 0)
                add_weightless(node, above);
    }

    /// The joint above a node, or the first one below it.
    int joint_near(int node, const std::vector<std::vector<int>>& branches) const
    {
        if (const int above = joint_from(scene_.parent(node)); above >= 0)
            return above;
        while (!is_joint(node))
            node = branches[std::size_t(node)].front();
        return node;
    }

    /// In the bind pose it lies as it does in the scene towards a joint. Not added where the scene shows that joint
    /// flat.
    void add_weightless(int node, int joint)
    {
        const Eigen::Affine3d node_from_joint = scene_.world_from_node(node).inverse() * scene_.world_from_node(joint);
        const Eigen::Affine3d node_from_world = node_from_joint * joints_[std::size_t(joint)]->joint_from_world;
        if (const Vec3 place = node_from_world.inverse().translation(); place.allFinite())
            joints_[std::size_t(node)] = { node_from_world, place };
    }

    /// The node, or the nearest one above it that is a joint; -1 where there is none.
    int joint_from(int node) const
    {
        while (node >= 0 && !is_joint(node))
            node = scene_.parent(node);
        return node;
    }

    int row_from(int node) const
    {
        const int joint = joint_from(node);
        return joint < 0 ? -1 : row_of_[std::size_t(joint)];
    }

    /// In the order of the scene. Those that a skin lists and the scene lacks come last.
    void list_joints()
    {
        for (const int node : scene_.nodes())
            if (is_joint(node))
                list_joint(node);
        for (int node = 0; node < int(model_.nodes.size()); ++node)
            if (is_joint(node) && row_of_[std::size_t(node)] < 0)
                list_joint(node);
    }

    void list_joint(int node)
    {
        row_of_[std::size_t(node)] = int(skin_.nodes.size());
        skin_.nodes.push_back(node);
        skin_.names.push_back(model_.nodes[std::size_t(node)].name);
        skin_.parents.push_back(row_from(scene_.parent(node)));
        skin_.joint_from_world.push_back(joints_[std::size_t(node)]->joint_from_world);
        skin_.places.push_back(joints_[std::size_t(node)]->place);
    }

    /// Eyes, hair and the like may be moved by a joint without a skin of their own.
    void read_weights(const GltfSurface& surface)
    {
        const std::size_t first = skin_.hangs.size();
        skin_.hangs.resize(first + surface.positions.count);
        if (const tinygltf::Skin* skin = skin_of(surface.node))
            for (int set = 0; read_set(surface, *skin, set, first);)
                ++set;
        else if (const int joint = row_from(surface.node); joint >= 0)
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
    std::vector<std::optional<Joint>> joints_;  // of each node, nothing for others
    std::vector<int> row_of_;  // of each node its row among the joints, -1 for others
    FileSkin skin_;
};

bool hangs_on(const std::set<int>& joints, const GltfScene& scene, int node)
{
    while (node >= 0 && !joints.contains(node))
        node = scene.parent(node);
    return node >= 0;
}

}  // namespace

bool shows_skeleton(const FileBytes& file, const tinygltf::Model& model)
{
    std::set<int> joints;
    for (const tinygltf::Skin& skin : model.skins)
        joints.insert(skin.joints.begin(), skin.joints.end());
    const GltfScene scene(file, model);
    const std::vector<GltfSurface> surfaces = scene.surfaces();
    return std::any_of(surfaces.begin(), surfaces.end(), [&](const GltfSurface& surface) {
        return model.nodes[std::size_t(surface.node)].skin >= 0 || hangs_on(joints, scene, surface.node);
    });
}

double positive(double weight) { return weight > 0 && std::isfinite(weight) ? weight : 0; }

int count_unnormalized(const FileSkin& skin)
{
    constexpr double k_precision = 0.01;  // unit: more than the rounding of four weights of a byte each
    int count = 0;
    for (int v = 0; v < int(skin.hangs.size()); ++v) {
        double sum = 0, least = 0;
        for (const auto& [joint, weight] : skin.hangs[std::size_t(v)]) {
            sum += weight;
            least = std::min(least, weight);
        }
        const bool is_loose = std::binary_search(skin.loose.begin(), skin.loose.end(), v);
        count += !is_loose && (!(std::abs(sum - 1) < k_precision) || least < -k_precision);
    }
    return count;
}

FileSkin read_skin(const FileBytes& file, const tinygltf::Model& model, NodesBelow below)
{
    return SkinReader(file, model).read(below);
}

}  // namespace garmentfit
