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

/// What the user says of meshes that are hard to read.
struct Hints {
    std::map<std::string, std::string> choices;  ///< of units and axes; what is missing is "auto"
    std::map<std::string, Vec3> joints;  ///< in the body's units and axes

    std::string choice(const std::string& what) const;
    /// All that a body is read by, as one text.
    std::string on_body() const;
    /// The same of garments.
    std::string on_garments() const;
};

/// The body, and what filters before found out about it. Its rig is looked for as `options` say.
/// @throws InvalidInput; so do the others.
KnownScene scene_of_body(const Filter& filter, vtkPolyData& body, const Hints& hints, RigOptions& options);
/// Puts garments into the scene for those that are there.
void read_garments(KnownScene& known, const Filter& filter, vtkDataObject& garments, const Hints& hints);
/// Body and garments as they were left in the pose that the garments are worn in.
void read_worn(KnownScene& known, vtkPolyData& body, vtkDataObject& garments);

}  // namespace garmentfit

#endif
