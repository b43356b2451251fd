// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A dressed body and its clothes in one file that other programs can pose.

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "garmentfit/filters/avatar_file.h"
#include "garmentfit/filters/filters.h"
#include "garmentfit/skinned_gltf.h"

namespace garmentfit {

/// What a file says of a mesh beside its shape.
struct OutfitPart {
    std::string name;
    Appearance look {};  ///< of the triangles of the mesh in the scene; empty where nothing is known
};

/// Joints that move a vertex of the clothes, at most: what all programs read, and two sets of that.
constexpr int k_few_influences = 4, k_many_influences = 8;

struct OutfitRequest {
    std::filesystem::path path;  ///< ends in .glb, or in .vrm, which has the joints of VRM whatever `bones` says
    std::optional<BoneNames> bones = {};  ///< none: the avatar's own, or garmentfit without one
    /// Leaves out faces of the body that clothes cover in all poses of everyday movement, and, but on an avatar's own
    /// bones, draws in what is under cloth (inset_skin).
    bool hide_covered_skin = false;
    std::optional<AvatarFile> avatar = {};  ///< whose file the body was read from, where it has a skin
    bool is_stripped = false;  ///< vertices of the body without faces are clothes that its file is to lose
    int influences = k_few_influences;  ///< joints that move a vertex of the clothes, at most; or k_many_influences
};

/// The name of no set: the joints are those of the body's file.
constexpr const char* k_own_bones = "own";

/// "garmentfit", "vrm", "mixamo", "unreal" and "smpl".
const std::vector<std::pair<std::string, BoneNames>>& bone_name_sets();

/// None for k_own_bones. @throws InvalidInput naming the sets that there are.
std::optional<BoneNames> bone_names_called(const std::string& name);

/// "four" and "eight".
const std::vector<std::pair<std::string, int>>& influence_choices();

/// @throws InvalidInput naming the choices.
int influences_called(const std::string& name);

/// Whether the outfit is the avatar's file with clothes added, which keeps all that it says of the body.
bool is_on_avatar(const OutfitRequest& request);

/// "" where an outfit can have this name; else a line that says which one it needs.
std::string fault_of_outfit_name(const std::filesystem::path& path);

/// Writes body and worn garments, in the body's input pose, as one skinned GLB: one skeleton, weights for all meshes.
/// On an avatar's own bones the file is the avatar's with the garments added (write_dressed_avatar). A name in .vrm asks
/// for that, or makes an avatar of VRM 1.0 where its file is none.
/// Makes the folder where there is none; never leaves a half-written file. Cost: some seconds for 10^4 vertices.
/// @param body, garments  in the order of the scene, for all of its garments
/// @throws InvalidInput: the pose is not recovered, the result is not certified, another name, a place that cannot be
/// written.
void write_outfit(const Scene& scene, const OutfitPart& body, const std::vector<OutfitPart>& garments,
                  const OutfitRequest& request);

}  // namespace garmentfit
