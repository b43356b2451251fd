// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Names of MeshLab since 2021.07; ../api_2020 has those of 2020.09.

#include <vector>

#include <common/plugins/interfaces/filter_plugin.h>

namespace garmentfit::meshlab {

using HostFilters = FilterPlugin;  ///< whose categories are HostFilters::Layer, ...
using ShownDocument = const MeshDocument;  ///< the argument of a dialog

#if __has_include(<common/parameters/rich_parameters.h>)  // since 2023.12
using LengthParameter = RichPercentage;
using OpenFileParameter = RichFileOpen;
using SaveFileParameter = RichFileSave;
#else
using LengthParameter = RichAbsPerc;
using OpenFileParameter = RichOpenFile;
using SaveFileParameter = RichSaveFile;
#endif

inline RichMesh layer_parameter(const QString& name, const MeshModel& layer, ShownDocument& document,
                                const QString& label, const QString& tip)
{
    return RichMesh(name, layer.id(), &document, label, tip);
}

inline MeshModel* chosen_layer(const RichParameterList& parameters, const QString& name, MeshDocument& document)
{
    return document.getMesh(parameters.getMeshId(name));
}

inline std::vector<const MeshModel*> layers_of(const MeshDocument& document)
{
    std::vector<const MeshModel*> layers;
    for (const MeshModel& layer : document.meshIterator())
        layers.push_back(&layer);
    return layers;
}

inline void set_visible(MeshDocument&, MeshModel& layer, bool visible) { layer.setVisible(visible); }

inline void update_box_and_normals(MeshModel& layer) { layer.updateBoxAndNormals(); }

/// Textures belong to layers, so a copy of the mesh lacks them.
inline void copy_textures(const MeshModel& from, MeshModel& to)
{
    for (const auto& [name, image] : from.getTextures())
        to.addTexture(name, image);
}

}  // namespace garmentfit::meshlab
