// SPDX-License-Identifier: GPL-3.0-or-later
#include "levels_of_detail.h"

#include <algorithm>
#include <map>
#include <memory>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "scene_nodes.h"

namespace garmentfit {
namespace {

/// The mesh that a node shows, and which level of it: 0 is the finest.
struct Level {
    std::string of = {};
    int number = -1;  // -1: none
};

Level level_of(const aiNode& node)
{
    static const std::regex k_name("(.*?)[ _.-]?lod_?([0-9]{1,2})", std::regex::icase);
    const std::string name = node.mName.C_Str();
    std::smatch match;
    if (node.mNumMeshes == 0 || !std::regex_match(name, match, k_name))
        return {};
    return { match[1], std::stoi(match[2]) };
}

/// Assimp writes skins of meshes that no node shows at a node that is not there.
void drop_unused_meshes(aiScene& scene)
{
    std::vector<char> is_used(scene.mNumMeshes, 0);
    visit_nodes(*scene.mRootNode, [&](const aiNode& node) {
        for (unsigned i = 0; i < node.mNumMeshes; ++i)
            is_used[node.mMeshes[i]] = 1;
    });
    std::vector<unsigned> number(scene.mNumMeshes);
    unsigned used = 0;
    for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
        const std::unique_ptr<aiMesh> unused(is_used[i] ? nullptr : scene.mMeshes[i]);
        if (is_used[i]) {
            number[i] = used;
            scene.mMeshes[used++] = scene.mMeshes[i];
        }
    }
    scene.mNumMeshes = used;
    visit_nodes(*scene.mRootNode, [&](aiNode& node) {
        for (unsigned i = 0; i < node.mNumMeshes; ++i)
            node.mMeshes[i] = number[node.mMeshes[i]];
    });
}

}  // namespace

void keep_finest_levels(aiScene& scene)
{
    std::map<std::string, int> finest;
    visit_nodes(*scene.mRootNode, [&](const aiNode& node) {
        if (const Level level = level_of(node); level.number >= 0) {
            const auto [known, is_new] = finest.emplace(level.of, level.number);
            known->second = std::min(known->second, level.number);
        }
    });
    if (finest.empty())
        return;
    visit_nodes(*scene.mRootNode, [&](aiNode& node) {
        if (const Level level = level_of(node); level.number > 0 && level.number > finest[level.of]) {
            delete[] std::exchange(node.mMeshes, nullptr);
            node.mNumMeshes = 0;
        }
    });
    drop_unused_meshes(scene);
}

}  // namespace garmentfit
