// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Runs one filter, from layers to new layers.

#include "garmentfit/progress.h"
#include "host_api.h"
#include "menu.h"
#include "report.h"

namespace garmentfit::meshlab {

/// All errors are thrown before the document changes. Layers are only added, and the current layer stays current.
/// @throws InvalidInput, SolverFailure, Cancelled.
Report run_entry(const MenuEntry& entry, const RichParameterList& list, MeshDocument& document,
                 const Progress& progress);

/// Reports to MeshLab at most ten times a second, and stops where the callback returns false.
Progress progress_to(vcg::CallBackPos* callback);

}  // namespace garmentfit::meshlab
