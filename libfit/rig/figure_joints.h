// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "figure_graph.h"
#include "joint_labels.h"

namespace garmentfit {

/// Places joints in a figure of any proportions: those of a limb by the limb's own length, hips as far apart as the
/// legs, the neck between shoulders and crown. Where a limb shows no joint, it is divided as a human's.
/// @throws InvalidInput when a curve has no skin.
BodyJoints label_figure(const TriangleMesh& proxy, const CurveSkeleton& skeleton, const Figure& figure);

}  // namespace garmentfit
