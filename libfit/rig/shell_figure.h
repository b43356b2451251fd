// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Figures whose head, trunk, arms and legs are shells of their own, such as blocks. Their arms may lie along the trunk
// and their legs on each other with whole sides, where no curve shows a limb; which shells are limbs shows by where
// they are.

#include <optional>
#include <vector>

#include "joint_labels.h"

namespace garmentfit {

struct ShellFigure {
    BodyJoints joints;
    std::vector<int> curve_of_vertex;  ///< as in BodyGraph::curve; those of no part are the trunk's
    double cost = 0;  ///< as Figure::cost
};

/// Of all shells that may be the trunk, the one that the others lie about as head, arms and legs do. Shells that lie in
/// each other, such as eyes, are one part; parts at one side and one height are one limb. O(n log n + p^3), p parts.
/// @param surface  as given, up is +y
/// @return nothing where the shells are none of these, or too many
std::optional<ShellFigure> shell_figure(const TriangleMesh& surface);

}  // namespace garmentfit
