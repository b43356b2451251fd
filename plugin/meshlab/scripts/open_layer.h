// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Fills documents without MeshLab's windows and readers.

#include <filesystem>

#include "garmentfit/types.h"
#include "host_api.h"

namespace garmentfit::meshlab {

/// A new layer with the name of a file that need not exist.
MeshModel& add_mesh(MeshDocument& document, const std::filesystem::path& path, const TriangleMesh& mesh);

/// A layer as MeshLab opens the file. @throws InvalidInput.
MeshModel& open_layer(MeshDocument& document, const std::filesystem::path& path);

}  // namespace garmentfit::meshlab
