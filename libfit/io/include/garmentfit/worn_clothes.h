// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Clothes that an avatar wears in its file already.

#include <string>
#include <string_view>
#include <vector>

#include "garmentfit/export.h"
#include "garmentfit/io.h"

namespace garmentfit {

/// What is done with them: they are part of the body, or left out of it.
enum class Wears { keep, strip };

/// In the order of Wears.
GARMENTFIT_API const std::vector<std::string_view>& wears_names();
/// @throws InvalidInput naming both.
GARMENTFIT_API Wears wears_called(std::string_view name);

/// What is left of an avatar's body without its clothes.
struct StrippedBody {
    std::vector<int> kept;  ///< rows of MeshFile::triangles(), ascending
    std::vector<std::string> stripped;  ///< names of the parts that are left out
    std::vector<std::string> warnings;  ///< of what cannot be left out, in whole sentences
};

/// Leaves out the parts that are named as clothes (by material, mesh or node) and have skin under them: each bone that
/// a part hangs on runs inside the skin that is left. Vertices stay, so that weights and files still fit. What has no
/// skin under it stays, with a warning; so does everything where no part is named as clothes, or where joints are
/// unknown, so that nothing tells where skin has to be.
GARMENTFIT_API StrippedBody strip_clothes(const MeshFile& avatar);

/// Which parts were left out, and which could not be, in whole sentences for the user.
GARMENTFIT_API std::vector<std::string> notes_on(const StrippedBody& body);

/// Rows of triangles and what belongs to them.
GARMENTFIT_API Triangles triangles_of(const MeshFile& avatar, const StrippedBody& body);
GARMENTFIT_API Appearance appearance_of(Appearance look, const StrippedBody& body);

}  // namespace garmentfit
