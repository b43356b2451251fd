// SPDX-License-Identifier: GPL-3.0-or-later

// From a scene to a pipeline's outputs. They are shallow copies of the inputs: unchanged data are not copied.

#ifndef scene_output_h
#define scene_output_h

#include <vector>

#include "garmentfit/filters/snapshot.h"
#include "known_scene.h"

class vtkPolyData;

namespace garmentfit {

void write_body(vtkPolyData& body, const Filter& filter, const KnownScene& known, const Snapshot& now);
void write_garments(const std::vector<vtkPolyData*>& garments, const Filter& filter, const KnownScene& known,
                    const Snapshot& now);
void write_skeleton(vtkPolyData& skeleton, const KnownScene& known, const Snapshot& now);

}  // namespace garmentfit

#endif
