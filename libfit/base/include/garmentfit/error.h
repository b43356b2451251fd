// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Who can repair it decides what is thrown.

#include <stdexcept>

#include "garmentfit/export.h"

namespace garmentfit {

/// The caller gave something wrong. One line: what is wrong, where, and what to do, with numbers.
class GARMENTFIT_API InvalidInput : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// No answer exists or none was found; slow convergence is not this but a field of the result.
class GARMENTFIT_API SolverFailure : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// The user changed their mind: a Progress was told to stop.
class GARMENTFIT_API Cancelled : public std::runtime_error {
public:
    Cancelled() : std::runtime_error("stopped by the user") { }
};

}  // namespace garmentfit
