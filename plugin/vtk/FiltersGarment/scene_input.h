// SPDX-License-Identifier: GPL-3.0-or-later

// From a pipeline's inputs to a scene.

#ifndef scene_input_h
#define scene_input_h

#include <map>
#include <optional>
#include <string>

#include "garmentfit/filters/frame_choice.h"
#include "known_scene.h"

class vtkDataObject;
class vtkPolyData;

namespace garmentfit {

/// Units, axes and joints set by the user.
struct Hints {
    std::map<std::string, std::string> choices;  ///< of units and axes; a missing one is "auto"
    std::map<std::string, Vec3> joints;  ///< in the body's units and axes

    std::string choice(const std::string& what) const;
    /// All hints on the body as one text, to detect changes.
    std::string on_body() const;
    /// The same for garments.
    std::string on_garments() const;
};

/// The body, and the results of earlier filters on it. Sets front and joints of the options of rigging.
/// @throws InvalidInput, as all functions here.
KnownScene scene_of_body(const Filter& filter, vtkPolyData& body, const Hints& hints, Parameters& parameters);
/// Replaces the garments of the scene.
void read_garments(KnownScene& known, const Filter& filter, vtkDataObject& garments, const Hints& hints,
                   const Parameters& parameters);
/// Reads body and garments in the pose that the garments are worn in.
void read_worn(KnownScene& known, vtkPolyData& body, vtkDataObject& garments);
/// The whole scene as the outputs of a filter that dresses show it; the dressing, certified again, is `draped`.
KnownScene scene_of_dressed(vtkPolyData& body, vtkDataObject& garments);

}  // namespace garmentfit

#endif
