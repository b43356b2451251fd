// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Rigged bodies as skinned glTF, so that other programs can pose them, and rigs made by other programs.

#include <filesystem>
#include <string>
#include <vector>

#include "garmentfit/appearance.h"
#include "garmentfit/export.h"
#include "garmentfit/garment_weights.h"
#include "garmentfit/skeleton.h"

namespace garmentfit {

/// One mesh of a skinned file, in the rest pose of its skeleton.
struct SkinnedMesh {
    std::string name;
    TriangleMesh surface;  ///< metres, +y up
    SkinWeights weights;  ///< a row for each vertex
    Appearance look {};  ///< of the triangles of `surface`
    std::vector<char> covered {};  ///< of each vertex, whether clothes cover it: attribute _COVERED, 1 or 0. Or empty
    bool hides_covered = false;  ///< leaves out faces of which all corners are covered, unless all are
    /// A row for each vertex and a column for each bone, instead of `weights`: for more than four bones a vertex, of
    /// which the file has the eight largest. Or empty.
    JointWeights more_weights {};
};

/// Whose names the joints have, and which joints there are. Other than garmentfit: hips, the spine's three, neck, head,
/// shoulders, arms, hands, legs, feet and toes as each program wants them; the skin of hands and feet follows them.
enum class BoneNames { garmentfit, vrm, mixamo, unreal, smpl };

struct OutfitOptions {
    BoneNames names = BoneNames::garmentfit;
    std::string title = "garmentfit";  ///< of the avatar, in the metadata of VRM
};

/// Writes body and clothes as one GLB: a mesh each, with its own vertices in their order, and one skin for all of them.
/// Where a vertex has several UVs, copies of it follow after all others; each material has a primitive of its own.
/// Joints as below. Never leaves a half-written file.
/// @throws InvalidInput: a mesh has not a row of weights for each vertex, or the place cannot be written.
GARMENTFIT_API void write_skinned_glb(const std::filesystem::path& path, const Skeleton& skeleton,
                                      const std::vector<SkinnedMesh>& meshes);

/// The same with joints for another program. For VRM with the humanoid map and metadata of VRM 1.0, standing in T pose
/// and facing +z as that format wants it; otherwise in the rest pose. @throws InvalidInput as above.
GARMENTFIT_API void write_outfit_glb(const std::filesystem::path& path, const Rig& rig,
                                     const std::vector<SkinnedMesh>& meshes, const OutfitOptions& options = {});

/// Writes a GLB: metres, +y up, one mesh, one skin. Joints have the names of Bone and are at the heads of the bones.
/// Head, hands, feet and their tips follow as joints without weight. Never leaves a half-written file.
GARMENTFIT_API void write_skinned_glb(const std::filesystem::path& path, const TriangleMesh& surface, const Rig& rig);

/// Bones and weights of a rig by another program, in the file's units and axes, vertices in the order of MeshFile.
/// Joints are recognised by the names of this library, Mixamo, Unreal, VRM, MakeHuman or SMPL, in a VRM by its own map,
/// and where names say nothing by their tree and places. Weights on fingers and toes go to the bone before them.
struct ForeignRig {
    Skeleton skeleton;
    SkinWeights weights;
    int loose_vertices
        = 0;  ///< those without a weight, or of meshes that hang on no joint: they follow the nearest one
    bool by_tree
        = false;  ///< names say nothing: joints were found by their tree and places, left and right by the feet
    int unnormalized_vertices = 0;  ///< those whose weights did not sum to 1, or were negative or no numbers
};

/// Whether a glTF or GLB shows a mesh with a skin. @throws InvalidInput: missing, not glTF.
GARMENTFIT_API bool has_skin(const std::filesystem::path& path);

/// Whether a glTF or GLB shows a body on a skeleton: a mesh with a skin, or rigid parts that hang on joints of one.
/// @throws InvalidInput: missing, not glTF.
GARMENTFIT_API bool has_skeleton(const std::filesystem::path& path);

/// All meshes of the scene are one body: joints of several skins are merged, and a mesh without a skin hangs on the
/// joint above it. What hangs on none, or has no weight, follows the nearest vertex that has one. @throws InvalidInput: not glTF, no skin, joints that a human needs have no known names.
GARMENTFIT_API ForeignRig read_skinned_gltf(const std::filesystem::path& path);

/// Weights of an avatar over the joints of its own file: a row for each vertex of MeshFile, a column for each joint of
/// its skins. What hangs on no joint follows as in read_skinned_gltf. @throws InvalidInput: not glTF, no skin.
GARMENTFIT_API JointWeights read_joint_weights(const std::filesystem::path& avatar);

/// Whether a glTF or GLB says that it is a VRM avatar, 0.x or 1.0. @throws InvalidInput: missing, not glTF.
GARMENTFIT_API bool is_vrm(const std::filesystem::path& path);

struct AvatarGarment {
    std::string name;
    TriangleMesh surface;  ///< on the avatar as MeshFile shows it, in its units and axes
    JointWeights weights;  ///< over the columns of read_joint_weights; the eight largest of a vertex count
    Appearance look {};  ///< of the triangles of `surface`
};

/// Writes an avatar's file with clothes as a GLB. All that the file has stays: nodes, skins, weights, materials,
/// animations, expressions, extensions. Each garment is a mesh more, with a skin over the avatar's joints, so that it
/// goes along with all that moves these. Packed geometry is written plain. Never leaves a half-written file.
/// @param covered  of each vertex of MeshFile, whether the clothes cover it: attribute _COVERED, 1 or 0; faces of which
///                 all corners are covered are left out. Or empty
/// @throws InvalidInput: not glTF, no skin, numbers of rows or columns differ, the place cannot be written.
GARMENTFIT_API void write_dressed_avatar(const std::filesystem::path& path, const std::filesystem::path& avatar,
                                         const std::vector<AvatarGarment>& garments,
                                         const std::vector<char>& covered = {});

}  // namespace garmentfit
