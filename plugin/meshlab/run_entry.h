// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// One filter, from layers in to layers out.

#include "garmentfit/progress.h"
#include "host_api.h"
#include "menu.h"
#include "report.h"

namespace garmentfit::meshlab {

/// Everything that can go wrong goes wrong before the document changes; layers are only added, and the current one stays.
/// @throws InvalidInput, SolverFailure, Cancelled.
Report run_entry(const MenuEntry& entry, const RichParameterList& list, MeshDocument& document,
                 const Progress& progress);

/// Reports to MeshLab ten times a second at most; stops when told to.
Progress progress_to(vcg::CallBackPos* callback);

}  // namespace garmentfit::meshlab
