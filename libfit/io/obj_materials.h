// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// UVs and materials of OBJ files: .mtl files and pictures beside them.

#include <filesystem>
#include <string>
#include <vector>

#include "file_bytes.h"
#include "garmentfit/appearance.h"

namespace garmentfit {

/// @param file  an OBJ file that was read without errors; its name is its path
Appearance obj_appearance(const FileBytes& file);

/// Its UVs without materials and pictures.
Appearance obj_uvs(const FileBytes& file);

/// The .mtl files that it names, and the pictures that those name: as written there, each once.
std::vector<std::string> obj_companions(const FileBytes& file);

/// The file's text with other numbers, its .mtl files in a folder beside it.
std::string with_libraries_in(const FileBytes& file, const std::string& bytes, const std::string& folder);

}  // namespace garmentfit
