// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/error.h"

namespace garmentfit {

std::string_view name_of(ErrorCode code)
{
    switch (code) {
    case ErrorCode::invalid_input: return "invalid_input";
    case ErrorCode::unreadable_file: return "unreadable_file";
    case ErrorCode::unwritable_file: return "unwritable_file";
    case ErrorCode::missing_input: return "missing_input";
    case ErrorCode::wrong_call: return "wrong_call";
    case ErrorCode::unknown_name: return "unknown_name";
    case ErrorCode::out_of_range: return "out_of_range";
    case ErrorCode::wrong_unit: return "wrong_unit";
    case ErrorCode::no_faces: return "no_faces";
    case ErrorCode::bad_index: return "bad_index";
    case ErrorCode::not_finite: return "not_finite";
    case ErrorCode::degenerate_mesh: return "degenerate_mesh";
    case ErrorCode::separate_pieces: return "separate_pieces";
    case ErrorCode::count_mismatch: return "count_mismatch";
    case ErrorCode::bad_rig: return "bad_rig";
    case ErrorCode::rig_mismatch: return "rig_mismatch";
    case ErrorCode::not_human: return "not_human";
    case ErrorCode::no_opening: return "no_opening";
    case ErrorCode::closed_garment: return "closed_garment";
    case ErrorCode::no_fit: return "no_fit";
    case ErrorCode::crossing_start: return "crossing_start";
    }
    return "invalid_input";
}

}  // namespace garmentfit
