// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/version.h"

namespace garmentfit {

const char* library_version() { return GARMENTFIT_VERSION; }

}  // namespace garmentfit
