// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// From layers to what a filter reads.

#include "choice.h"
#include "fitting.h"
#include "report.h"

namespace garmentfit::meshlab {

/// The chosen body and garments, and the results of earlier filters: from the document, else from the file beside the
/// body's. @throws InvalidInput where these are missing, or a layer was changed since.
Fitting inputs_of(const MenuEntry& entry, const Choice& choice, const MeshDocument& document, Report& report);

/// Of a rig file, with a warning where its skeleton seems wrong. @throws InvalidInput where it is the rig of another body.
Fitting fitting_from_file(const std::filesystem::path& file, const MeshModel& body, Report& report);

}  // namespace garmentfit::meshlab
