// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Results on a body that later filters read. The layers that a filter makes carry them in a document; a file beside the
// body's file carries them from document to document, because MeshLab's own formats drop them.

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "garmentfit/filters/filters.h"
#include "garmentfit/filters/rig_file.h"
#include "garmentfit/units.h"
#include "host_api.h"

namespace garmentfit::meshlab {

/// A scene, and the names and frames of the layers that it was read from.
struct Fitting {
    Scene scene;
    std::string body_name;
    Frame body_frame;
    std::vector<std::string> garment_names;
    std::vector<Frame> garment_frames;
    std::vector<std::filesystem::path> garment_files;  ///< empty for a layer without a file

    /// Whether the vertices and faces, in world axes and units, are the scene's.
    bool is_of_body(const TriangleMesh& body) const;
    bool is_of_garments(const std::vector<TriangleMesh>& garments) const;
};

using SharedFitting = std::shared_ptr<const Fitting>;

/// Attaches a fitting to a layer until the layer is deleted. Several layers may share one.
void attach(MeshDocument& document, const MeshModel& layer, const SharedFitting& fitting);

/// Whether a filter of this plugin made the layer.
bool is_result(const MeshDocument& document, const MeshModel& layer);

/// The newest fitting in the document that is suitable, or null.
SharedFitting find_fitting(const MeshDocument& document, const std::function<bool(const Fitting&)>& is_suitable);

/// "/home/me/man.rig.json" for "/home/me/man.ply"; empty for a layer without a file.
std::filesystem::path rig_file_beside(const MeshModel& body);

/// "/home/me/man.outfit.glb" for "/home/me/man.ply"; empty for a layer without a file.
std::filesystem::path outfit_beside(const MeshModel& body);

/// Reads a rig file. @throws InvalidInput where it is the rig of another body.
Fitting fitting_from_file(const std::filesystem::path& path, const std::string& body_name, const TriangleMesh& body);

/// The contents of a rig file.
RigFile rig_file_of(const Fitting& fitting);

}  // namespace garmentfit::meshlab
