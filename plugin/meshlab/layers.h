// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Between MeshLab's layers and plain arrays. World axes and units: what is read has the layer's matrix applied, what is
// made has none.

#include <string>
#include <vector>

#include "garmentfit/error.h"
#include "garmentfit/skeleton.h"
#include "garmentfit/types.h"
#include "host_api.h"

namespace garmentfit::meshlab {

/// Vertices and faces that are not deleted, in their order.
TriangleMesh mesh_of(const MeshModel& layer);

std::vector<TriangleMesh> meshes_of(const std::vector<MeshModel*>& layers);

/// The layer's name without a file's extension.
std::string name_of(const MeshModel& layer);

/// What `make` returns. @throws InvalidInput in its words, after the layer's name.
template <class Make>
auto with_name(const MeshModel& layer, const Make& make)
{
    try {
        return make();
    } catch (const InvalidInput& error) {
        throw InvalidInput(name_of(layer) + ": " + error.what());
    }
}

/// As many digits as a layer keeps.
Positions as_kept(const Positions& positions);

/// A new layer with faces, texture and all that `from` has, its vertices elsewhere. The current layer stays the same.
MeshModel& add_moved_copy(MeshDocument& document, MeshModel& from, const std::string& name, const Positions& positions);

/// A new layer with a vertex for each joint and tip, and an edge for each bone and extremity.
/// @param joints  in the order of rows_of(Skeleton)
MeshModel& add_skeleton(MeshDocument& document, const std::string& name, const Positions& joints);

/// One value for each vertex, under a name.
void add_attribute(MeshModel& layer, const std::string& name, const Eigen::VectorXd& values);

/// Values as quality, and as colours from red at `red` to blue at `blue`.
void show_quality(MeshModel& layer, const Eigen::VectorXd& values, double red, double blue);

}  // namespace garmentfit::meshlab
