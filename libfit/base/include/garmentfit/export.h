// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Everything in libfit is hidden but what carries this mark.
#define GARMENTFIT_API __attribute__((visibility("default")))
