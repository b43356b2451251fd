// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Names of MeshLab 2020.09 that later versions changed; ../api_2021 has theirs.

#include <vector>

#include <common/interfaces.h>

namespace garmentfit::meshlab {

using HostFilters = MeshFilterInterface;  ///< whose categories are HostFilters::Layer, ...
using ShownDocument = MeshDocument;  ///< the argument of a dialog

using LengthParameter = RichAbsPerc;
using OpenFileParameter = RichOpenFile;
using SaveFileParameter = RichSaveFile;

inline RichMesh layer_parameter(const QString& name, const MeshModel& layer, ShownDocument& document,
                                const QString& label, const QString& tip)
{
    return RichMesh(name, const_cast<MeshModel*>(&layer), &document, label, tip);
}

inline MeshModel* chosen_layer(const RichParameterList& parameters, const QString& name, MeshDocument&)
{
    return parameters.getMesh(name);
}

inline std::vector<const MeshModel*> layers_of(const MeshDocument& document)
{
    return { document.meshList.begin(), document.meshList.end() };
}

inline void set_visible(MeshDocument& document, MeshModel& layer, bool visible)
{
    document.setVisible(layer.id(), visible);
}

inline void update_box_and_normals(MeshModel& layer) { layer.UpdateBoxAndNormals(); }

/// Textures are files that a mesh names: a copy of the mesh has them already.
inline void copy_textures(const MeshModel&, MeshModel&) { }

}  // namespace garmentfit::meshlab
