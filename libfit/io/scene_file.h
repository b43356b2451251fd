// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// FBX and COLLADA as glTF, by Assimp: what reads glTF need not know of them.

#include "file_bytes.h"

namespace garmentfit {

/// By content: FBX, binary or text, or COLLADA.
bool is_scene_file(const FileBytes& file);

/// The scene as GLB: nodes, meshes, skins, materials, animations. Polygons are cut into triangles, corners of faces that
/// have the same position, normal and UVs become one vertex, and of more than four joints of a vertex the strongest
/// stay. @throws InvalidInput: mangled, or nothing that glTF can hold
FileBytes glb_of_scene(const FileBytes& file);

}  // namespace garmentfit
