// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

#include "garmentfit/mesh.h"
#include "garmentfit/skeleton.h"

namespace garmentfit {

/// Some vertices of a rigged body, with triangles of their own.
struct PartialBody {
    Rig rig;
    BodyMesh body;

    /// @param vertices   of the whole body
    /// @param triangles  in the order of these
    PartialBody(const Rig& of_whole, const BodyMesh& whole, const std::vector<int>& vertices, Triangles triangles) :
        rig(of_whole), body { { whole.surface.positions(vertices, Eigen::all), std::move(triangles) },
                              whole.closed,
                              whole.repaired }
    {
        rig.weights.bones = of_whole.weights.bones(vertices, Eigen::all);
        rig.weights.weights = of_whole.weights.weights(vertices, Eigen::all);
    }
};

}  // namespace garmentfit
