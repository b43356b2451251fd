// SPDX-License-Identifier: GPL-3.0-or-later
#include "gltf_stale.h"

#include <algorithm>
#include <cmath>

namespace garmentfit {
namespace {

using nlohmann::ordered_json;

bool is_of_skin(const std::string& attribute)
{
    return attribute.starts_with("JOINTS_") || attribute.starts_with("WEIGHTS_");
}

ordered_json& mesh_of(ordered_json& json, const ordered_json& node)
{
    return json["meshes"].at(node.at("mesh").get<std::size_t>());
}

void strip_mesh(ordered_json& mesh)
{
    for (ordered_json& primitive : mesh.at("primitives")) {
        primitive.erase("targets");
        ordered_json kept = ordered_json::object();
        for (const auto& [name, accessor] : primitive.at("attributes").items())
            if (name != "TANGENT" && !is_of_skin(name))
                kept[name] = accessor;
        primitive["attributes"] = kept;
    }
    mesh.erase("weights");  // of morph targets
    if (mesh.contains("extras") && mesh["extras"].is_object())
        mesh["extras"].erase("targetNames");
}

ordered_json matrix_of(const Eigen::Affine3d& transform)
{
    ordered_json matrix = ordered_json::array();
    for (int k = 0; k < 16; ++k)
        matrix.push_back(transform.matrix()(k % 4, k / 4));
    return matrix;
}

/// That which is shown, as readers take it: members of another type than they should have do not count.
ordered_json& shown_scene(ordered_json& json)
{
    ordered_json& scenes = json["scenes"];
    const auto given = json.find("scene");
    const double number = given != json.end() && given->is_number() ? given->get<double>() : 0;
    const bool is_one = number >= 0 && number < double(scenes.size()) && number == std::floor(number);
    return scenes.at(is_one ? std::size_t(number) : 0);
}

/// A skin ignores the place of its node; without it the place counts.
void hang_on_own_node(ordered_json& json, const WrittenNode& written)
{
    ordered_json& nodes = json["nodes"];
    const ordered_json given = nodes[std::size_t(written.node)];
    ordered_json own { { "mesh", given.at("mesh") } };
    if (const auto name = given.find("name"); name != given.end())
        own["name"] = *name;
    if (!written.world_from_mesh.matrix().isIdentity(0))
        own["matrix"] = matrix_of(written.world_from_mesh);
    for (const char* member : { "mesh", "skin", "weights" })
        nodes[std::size_t(written.node)].erase(member);
    if (json.contains("scenes") && !json["scenes"].empty())
        shown_scene(json)["nodes"].push_back(nodes.size());
    nodes.push_back(own);
}

void remove_unused_skins(ordered_json& json)
{
    const ordered_json& nodes = json["nodes"];
    if (std::none_of(nodes.begin(), nodes.end(), [](const ordered_json& node) { return node.contains("skin"); }))
        json.erase("skins");
}

}  // namespace

std::vector<std::string> list_stale(const ordered_json& json, const std::vector<int>& nodes)
{
    bool has_skin = false, has_targets = false, has_tangents = false;
    for (const int index : nodes) {
        const ordered_json& node = json.at("nodes").at(std::size_t(index));
        has_skin = has_skin || node.contains("skin");
        for (const ordered_json& primitive :
             json.at("meshes").at(node.at("mesh").get<std::size_t>()).at("primitives")) {
            has_targets = has_targets || primitive.contains("targets");
            has_tangents = has_tangents || primitive.at("attributes").contains("TANGENT");
        }
    }
    std::vector<std::string> stale;
    if (has_skin)
        stale.push_back("a skin");
    if (has_targets)
        stale.push_back("morph targets");
    if (has_tangents)
        stale.push_back("tangents");
    if (json.contains("animations"))
        stale.push_back("animations");
    return stale;
}

void remove_stale(ordered_json& json, const std::vector<WrittenNode>& nodes)
{
    bool hangs_on_own = false;
    for (const WrittenNode& each : nodes) {
        ordered_json& node = json["nodes"].at(std::size_t(each.node));
        if (each.has_moved) {
            strip_mesh(mesh_of(json, node));
            node.erase("weights");
            hangs_on_own |= each.is_placed_anew || node.contains("skin");
        }
        if (hangs_on_own)
            hang_on_own_node(json, each);
    }
    json.erase("animations");
    remove_unused_skins(json);
}

}  // namespace garmentfit
