// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Makes the dialogs, and the fields of scripts, from the schema; choice.h reads them.

#include "host_api.h"
#include "menu.h"

namespace garmentfit::meshlab {

/// Empty where the document has no layer.
RichParameterList dialog_for(const MenuEntry& entry, ShownDocument& document);

}  // namespace garmentfit::meshlab
