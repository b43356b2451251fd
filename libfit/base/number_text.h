// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The name that the header had before hosts used it, too: for sources that still include it.

#include "garmentfit/number_text.h"
