// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Where cloth is led apart that hangs together.

#include <vector>

#include "embedded_motion.h"
#include "topology.h"

namespace garmentfit {

/// Whether an edge between two vertices grows far longer than cloth does.
bool is_torn(const Positions& rest, const Positions& worn, int a, int b);
bool has_tears(const Positions& rest, const Positions& worn, const MeshTopology& topology);

/// Cloth in patches of k_patch round some of its vertices, as a mesh of these.
class PatchedCloth {
public:
    /// Keeps a reference to the cloth. O(n log n). @param topology  of the cloth
    PatchedCloth(const TriangleMesh& cloth, const MeshTopology& topology);

    /// Of each vertex whether most of the cloth round its patch, within k_cloth_around over the cloth, would take it
    /// elsewhere, beside tears; or the middle of its patch would. O(n log n).
    std::vector<char> find_led_apart(const LedPlaces& led) const;

private:
    std::vector<int> patches_at_tears(const LedPlaces& led) const;
    bool is_led_apart(int patch, const LedPlaces& led) const;
    bool goes_elsewhere(int vertex, int other, double distance, const LedPlaces& led) const;

    const TriangleMesh& cloth_;
    const MeshTopology& cloth_topology_;
    std::vector<int> centres_, patch_of_;  // vertices; by vertex
    Positions rest_;  // of the centres
    MeshTopology topology_;  // of the patches
};

}  // namespace garmentfit
