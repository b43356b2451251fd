// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A filter's parameters, from the one description to MeshLab's dialogs and scripts; choice.h reads them.

#include "host_api.h"
#include "menu.h"

namespace garmentfit::meshlab {

/// Nothing where the document has no layer.
RichParameterList dialog_for(const MenuEntry& entry, ShownDocument& document);

}  // namespace garmentfit::meshlab
