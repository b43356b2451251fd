// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// From layers to what a filter reads.

#include "choice.h"
#include "fitting.h"
#include "report.h"

namespace garmentfit::meshlab {

/// The chosen body and garments, and what filters before found out about them: in the document, else in the file beside
/// the body's. @throws InvalidInput: no such thing, no rig yet, or a layer was changed since.
Fitting inputs_of(const MenuEntry& entry, const Choice& choice, const MeshDocument& document, Report& report);

}  // namespace garmentfit::meshlab
