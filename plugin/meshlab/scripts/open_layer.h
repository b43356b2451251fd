// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Documents without MeshLab's own windows and readers.

#include <filesystem>

#include "garmentfit/types.h"
#include "host_api.h"

namespace garmentfit::meshlab {

/// A new layer, tied to a file that need not exist.
MeshModel& add_mesh(MeshDocument& document, const std::filesystem::path& path, const TriangleMesh& mesh);

/// A layer as MeshLab itself opens the file. @throws InvalidInput.
MeshModel& open_layer(MeshDocument& document, const std::filesystem::path& path);

}  // namespace garmentfit::meshlab
