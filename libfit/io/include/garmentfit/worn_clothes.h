// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What an avatar's file shows besides its body: clothes that it wears already, and scenery.

#include <optional>
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

/// What of an avatar's file is its body.
struct StrippedBody {
    std::vector<int> kept;  ///< rows of MeshFile::triangles(), ascending
    std::vector<std::string> stripped;  ///< names of the clothes that are left out
    std::vector<std::string> scenery;  ///< names of the other parts that are left out
    std::vector<std::string> warnings;  ///< of what cannot be left out, in whole sentences
};

/// Leaves out scenery, which no joint moves and which lies away from what joints move (a desk, a floor, a stand), or
/// which is flat where the file has no joints, and clothes if `wears` says so: parts that are named as clothes (by
/// material, mesh or node) and have skin under them, which is where each bone that a part hangs on runs inside the skin
/// that is left. Vertices stay, so that weights and files still fit. Clothes that have no skin under them stay, with a
/// warning; so do all where no part is named as clothes, or where joints are unknown, so that nothing tells where skin
/// has to be. Nothing without scenery where clothes are kept.
GARMENTFIT_API std::optional<StrippedBody> find_body(const MeshFile& avatar, Wears wears);

/// Of a dressed figure that is given as a garment the body would be cloth, too, and no pose would be found for it.
/// @throws InvalidInput naming the clothes that find_body would leave out, if there are any
GARMENTFIT_API void require_no_body(const MeshFile& garment);

/// Which parts were left out, and which could not be, in whole sentences for the user.
GARMENTFIT_API std::vector<std::string> notes_on(const StrippedBody& body);

/// Rows of triangles and what belongs to them.
GARMENTFIT_API Triangles triangles_of(const MeshFile& avatar, const StrippedBody& body);
GARMENTFIT_API Appearance appearance_of(Appearance look, const StrippedBody& body);

}  // namespace garmentfit
