// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What is thrown. The classes differ by who can repair it: the caller, nobody, a caller who changed their mind, or one
// who gives more time.

#include <stdexcept>
#include <string>
#include <string_view>

#include "garmentfit/export.h"

namespace garmentfit {

/// What is wrong with an input, for programs. Names and meanings stay as they are; later versions may add some.
/// docs/command-line.md lists them with what to do.
enum class ErrorCode {
    invalid_input,  ///< none of those below
    unreadable_file,  ///< a file is missing, cannot be opened, or its content is not of its format
    unwritable_file,  ///< a file or folder cannot be written
    missing_input,  ///< a step lacks what a step before it makes
    wrong_call,  ///< the arguments do not go together
    unknown_name,  ///< no such type, unit, axis, joint, parameter or filter
    out_of_range,  ///< a number is outside of its range
    wrong_unit,  ///< a garment is so much larger or smaller than the body that one of their units must be wrong
    no_faces,  ///< a mesh has vertices, but no surface
    bad_index,  ///< a face names a vertex that does not exist
    not_finite,  ///< a coordinate is infinite or not a number
    degenerate_mesh,  ///< a surface has no area, or encloses no volume
    separate_pieces,  ///< a body consists of pieces that lie apart
    count_mismatch,  ///< two arrays or meshes that belong together differ in size
    bad_rig,  ///< a skeleton, its weights or a pose break a rule that all of them keep
    rig_mismatch,  ///< a rig is of another body, or of this one in another pose
    not_human,  ///< a body has not the limbs or the proportions of a human
    no_opening,  ///< a garment has too few openings for its type to be found
    closed_garment,  ///< a garment has no opening at all
    no_fit,  ///< no pose brings the body into the garment
    crossing_start,  ///< body and garment cross before the first step
};

/// "unreadable_file", ...
GARMENTFIT_API std::string_view name_of(ErrorCode code);

/// The caller gave something wrong. One line: what is wrong, where, and what to do, with numbers.
class GARMENTFIT_API InvalidInput : public std::runtime_error {
public:
    InvalidInput(ErrorCode code, const std::string& line) : std::runtime_error(line), code_(code) { }
    explicit InvalidInput(const std::string& line) : InvalidInput(ErrorCode::invalid_input, line) { }

    ErrorCode code() const { return code_; }

private:
    ErrorCode code_;
};

/// No answer exists or none was found. Slow convergence is not this, but a field of the result.
class GARMENTFIT_API SolverFailure : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// The user changed their mind: a Progress was told to stop.
class GARMENTFIT_API Cancelled : public std::runtime_error {
public:
    Cancelled() : std::runtime_error("stopped by the user") { }
};

/// The deadline of a Progress passed in work that has no result to return yet.
class GARMENTFIT_API TimeLimitReached : public std::runtime_error {
public:
    TimeLimitReached() : TimeLimitReached("the time limit was reached") { }
    explicit TimeLimitReached(const std::string& line) : std::runtime_error(line) { }
};

}  // namespace garmentfit
