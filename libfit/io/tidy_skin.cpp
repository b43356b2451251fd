// SPDX-License-Identifier: GPL-3.0-or-later
#include "tidy_skin.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "data_uri.h"
#include "gltf_append.h"
#include "gltf_scene.h"
#include "joint_tree.h"

namespace garmentfit {
namespace {

using nlohmann::ordered_json;

// ---- weights -------------------------------------------------------------------------------------------------------

/// Whether the format allows the joints and weights of a vertex. Slots without weight have the joint 0 of the skin.
bool is_tidy(const std::vector<std::pair<int, double>>& hang, int first_joint)
{
    constexpr double k_precision = 2e-7;  // unit: rounding of a float, of each weight, as the Khronos validator has it
    std::set<int> joints;
    double sum = 0;
    for (const auto& [joint, weight] : hang) {
        if (weight > 0 ? !joints.insert(joint).second : weight != 0 || joint != first_joint)
            return false;
        sum += weight;
    }
    return std::abs(sum - 1) <= k_precision * double(joints.size());
}

/// Rows of `skin` of the joints that a skin of the file lists. Of a node that it lists twice, the first place counts.
std::vector<int> rows_of(const FileSkin& skin, const std::vector<int>& nodes)
{
    std::vector<int> rows;
    for (const int node : nodes)
        rows.push_back(int(std::find(skin.nodes.begin(), skin.nodes.end(), node) - skin.nodes.begin()));
    return rows;
}

int count_sets(const ordered_json& attributes)
{
    int sets = 0;
    while (attributes.contains("JOINTS_" + std::to_string(sets))
           && attributes.contains("WEIGHTS_" + std::to_string(sets)))
        ++sets;
    return sets;
}

/// Weights of a mesh as places in the list of joints of its skin, in so many sets of four. What follows a vertex of
/// another mesh, by joints that its own skin lacks, follows the first joint.
FileWeights weights_in_file(const JointWeights& weights, const std::vector<int>& rows, int sets)
{
    FileWeights result = file_weights(weights, rows);
    const Eigen::Index strongest = std::min<Eigen::Index>(result.joints.cols(), 4 * sets);
    FileWeights fitting;
    fitting.joints.setZero(result.joints.rows(), 4 * sets);
    fitting.weights.setZero(result.weights.rows(), 4 * sets);
    fitting.joints.leftCols(strongest) = result.joints.leftCols(strongest);
    fitting.weights.leftCols(strongest) = result.weights.leftCols(strongest);
    for (Eigen::Index v = 0; v < fitting.weights.rows(); ++v)
        if (const double sum = fitting.weights.row(v).sum(); sum > 0)
            fitting.weights.row(v) /= sum;
        else
            fitting.weights(v, 0) = 1;
    return fitting;
}

/// Other values for an accessor that the file has.
template <class Number, class Matrix>
void replace_accessor(GltfContainer& container, std::size_t accessor, const Matrix& values)
{
    add_accessor<Number>(container, values, TINYGLTF_TYPE_VEC4, TINYGLTF_TARGET_ARRAY_BUFFER);
    ordered_json& accessors = container.json["accessors"];
    accessors[accessor] = accessors.back();
    accessors.erase(accessors.size() - 1);
}

void replace_sets(GltfContainer& container, const ordered_json& attributes, const FileWeights& skin)
{
    const bool has_many = skin.joints.size() > 0 && skin.joints.maxCoeff() > std::numeric_limits<std::uint8_t>::max();
    for (int set = 0; 4 * set < int(skin.joints.cols()); ++set) {
        const std::size_t joints = attributes.at("JOINTS_" + std::to_string(set)),
                          weights = attributes.at("WEIGHTS_" + std::to_string(set));
        if (has_many)
            replace_accessor<std::uint16_t>(container, joints, skin.joints.middleCols(4 * set, 4));
        else
            replace_accessor<std::uint8_t>(container, joints, skin.joints.middleCols(4 * set, 4));
        replace_accessor<float>(container, weights, skin.weights.middleCols(4 * set, 4));
    }
}

// ---- nodes of skinned meshes ---------------------------------------------------------------------------------------

/// Of each node the one that has it among its children; a root has itself.
std::vector<std::size_t> parents_in(const ordered_json& nodes)
{
    std::vector<std::size_t> parents(nodes.size());
    std::iota(parents.begin(), parents.end(), std::size_t(0));
    for (std::size_t i = 0; i < nodes.size(); ++i)
        if (const auto children = nodes[i].find("children"); children != nodes[i].end())
            for (const std::size_t child : *children)
                if (child < parents.size())
                    parents[child] = i;
    return parents;
}

std::size_t root_above(const std::vector<std::size_t>& parents, std::size_t node)
{
    std::size_t steps = 0;
    while (parents[node] != node && ++steps < parents.size())  // a circle, which no scene shows, has no root
        node = parents[node];
    return node;
}

void remove_child(ordered_json& parent, std::size_t node)
{
    ordered_json& children = parent["children"];
    children.erase(std::find(children.begin(), children.end(), node));
    if (children.empty())
        parent.erase("children");
}

}  // namespace

void free_skinned_meshes(ordered_json& json)
{
    ordered_json& nodes = json["nodes"];
    const std::vector<std::size_t> parents = parents_in(nodes);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (!nodes[i].contains("skin") || !nodes[i].contains("mesh") || nodes[i].contains("children"))
            continue;
        for (const char* transform : { "matrix", "translation", "rotation", "scale" })
            nodes[i].erase(transform);
        if (parents[i] == i)
            continue;
        remove_child(nodes[parents[i]], i);
        if (json.contains("scenes"))
            for (ordered_json& scene : json["scenes"])
                if (const auto shown = scene.find("nodes"); shown != scene.end()
                    && std::find(shown->begin(), shown->end(), root_above(parents, i)) != shown->end())
                    shown->push_back(i);
    }
}

void move_pictures_into_buffer(GltfContainer& container)
{
    if (!container.json.contains("images"))
        return;
    for (ordered_json& picture : container.json["images"]) {
        const std::optional<EmbeddedData> data = read_data_uri(picture.value("uri", std::string()));
        if (!data)
            continue;
        std::string& buffer = *container.own_buffer();
        buffer.resize((buffer.size() + 3) / 4 * 4, '\0');
        picture.erase("uri");
        picture["bufferView"] = count_of(container.json, "bufferViews");
        picture["mimeType"] = data->mime_type;
        container.json["bufferViews"].push_back(
            { { "buffer", 0 }, { "byteOffset", buffer.size() }, { "byteLength", data->bytes.size() } });
        buffer += data->bytes;
        container.json["buffers"][0]["byteLength"] = buffer.size();
    }
}

void tidy_weights(GltfContainer& container, const FileBytes& file, const tinygltf::Model& model, const FileSkin& skin,
                  const JointWeights& weights)
{
    const std::set<int> loose(skin.loose.begin(), skin.loose.end());
    std::size_t end = 0;
    for (const GltfSurface& surface : GltfScene(file, model).surfaces()) {
        if (!surface.adds_vertices)
            continue;
        const std::size_t begin = std::exchange(end, end + surface.positions.count);
        const ordered_json attributes = primitive_in(container.json, model, surface).at("attributes");
        const int mesh_skin = model.nodes[std::size_t(surface.node)].skin, sets = count_sets(attributes);
        if (mesh_skin < 0 || sets == 0)
            continue;
        const std::vector<int> rows = rows_of(skin, model.skins[std::size_t(mesh_skin)].joints);
        bool are_tidy = true;
        for (std::size_t v = begin; v < end && are_tidy; ++v)
            are_tidy = loose.count(int(v)) == 0 && is_tidy(skin.hangs[v], rows.front());
        if (!are_tidy)
            replace_sets(
                container, attributes,
                weights_in_file(weights.middleRows(Eigen::Index(begin), Eigen::Index(end - begin)), rows, sets));
    }
}

}  // namespace garmentfit
