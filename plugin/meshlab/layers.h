// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Between MeshLab's layers and plain arrays, in world axes and units: layers are read with their matrix applied; new
// layers have none.

#include <string>
#include <vector>

#include "garmentfit/error.h"
#include "garmentfit/skeleton.h"
#include "garmentfit/types.h"
#include "host_api.h"

namespace garmentfit::meshlab {

/// Vertices and faces that are not deleted, in their order.
TriangleMesh mesh_of(const MeshModel& layer);

/// Texture coordinates of the corners of those faces, or else of their vertices; no rows where there are none.
CornerUvs corner_uvs_of(const MeshModel& layer);

std::vector<TriangleMesh> meshes_of(const std::vector<MeshModel*>& layers);

/// The layer's name without a file's extension.
std::string name_of(const MeshModel& layer);

/// Returns make(). @throws InvalidInput with the layer's name before its message.
template <class Make>
auto with_name(const MeshModel& layer, const Make& make)
{
    try {
        return make();
    } catch (const InvalidInput& error) {
        throw InvalidInput(error.code(), name_of(layer) + ": " + error.what());
    }
}

/// Rounded to the digits that a layer keeps.
Positions as_kept(const Positions& positions);

/// A new layer with faces, texture and attributes of `from` at other positions. The current layer stays the same.
MeshModel& add_moved_copy(MeshDocument& document, MeshModel& from, const std::string& name, const Positions& positions);

/// A new layer with a vertex for each joint and tip, and an edge for each bone and extremity.
/// @param joints  in the order of rows_of(Skeleton)
MeshModel& add_skeleton(MeshDocument& document, const std::string& name, const Positions& joints);

/// Adds a named attribute with one value for each vertex.
void add_attribute(MeshModel& layer, const std::string& name, const Eigen::VectorXd& values);

/// Sets quality to the values, and colours from red at `red` to blue at `blue`.
void show_quality(MeshModel& layer, const Eigen::VectorXd& values, double red, double blue);

}  // namespace garmentfit::meshlab
