// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What is known about a body, handed on from filter to filter: in the document by the layers that filters make, and by a
// file beside the body's own after saving and loading, which MeshLab does without anything of ours.

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

/// A scene, and how it came from layers.
struct Fitting {
    Scene scene;
    std::string body_name;
    Frame body_frame;
    std::vector<std::string> garment_names;
    std::vector<Frame> garment_frames;

    /// The same vertices and faces, told from world axes and units.
    bool is_of_body(const TriangleMesh& body) const;
    bool is_of_garments(const std::vector<TriangleMesh>& garments) const;
};

using SharedFitting = std::shared_ptr<const Fitting>;

/// Ties a fitting to a layer until that is deleted; several layers may share one.
void hand_on(MeshDocument& document, const MeshModel& layer, const SharedFitting& fitting);

/// Whether a filter of ours made the layer.
bool is_result(const MeshDocument& document, const MeshModel& layer);

/// The newest fitting in the document that will do, or null.
SharedFitting find_fitting(const MeshDocument& document, const std::function<bool(const Fitting&)>& will_do);

/// "/home/me/man.rig.json" for "/home/me/man.ply"; empty for a layer without a file.
std::filesystem::path rig_file_beside(const MeshModel& body);

/// What a rig file says about a body. @throws InvalidInput where it is another body's.
Fitting fitting_from_file(const std::filesystem::path& path, const std::string& body_name, const TriangleMesh& body);

/// The same the other way.
RigFile rig_file_of(const Fitting& fitting);

}  // namespace garmentfit::meshlab
