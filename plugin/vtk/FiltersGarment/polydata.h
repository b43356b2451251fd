// SPDX-License-Identifier: GPL-3.0-or-later

// Meshes in vtkPolyData, and composites of them.

#ifndef polydata_h
#define polydata_h

#include <string>
#include <vector>

#include "garmentfit/fit_skeleton.h"
#include "garmentfit/types.h"
#include "garmentfit/units.h"

class vtkDataObject;
class vtkPolyData;

namespace garmentfit {

/// Points in the units and axes of the file, and polygons as fans of triangles.
/// @throws InvalidInput naming `what` where there are no polygons.
TriangleMesh mesh_of(vtkPolyData& data, const std::string& what);
/// The same with the points of the array `name`, where there is such an array.
TriangleMesh mesh_at(vtkPolyData& data, const char* name, const std::string& what);

/// Texture coordinates of the points at the corners of these triangles; no rows where there are none.
CornerUvs corner_uvs_of(vtkPolyData& data, const Triangles& triangles);

/// Leaves of a composite, or the one mesh. @throws InvalidInput where a leaf is no vtkPolyData.
std::vector<vtkPolyData*> garments_in(vtkDataObject& data);
/// Their names: of the blocks, or else by number.
std::vector<std::string> garment_names_in(vtkDataObject& data);
/// From the string GarmentType in its field data. @throws InvalidInput listing the types.
GarmentType given_type(vtkPolyData& garment);

/// Moves the points to `metres`, keeps the old ones as `name`, and computes point normals anew.
void move_points(vtkPolyData& data, const char* name, const Positions& metres, const Triangles& triangles,
                 const Frame& frame);
/// Reverts move_points: the points are again those kept as `name`, the same memory.
void restore_points(vtkPolyData& data, const char* name);
/// Lines from joint to joint, with the names of joints and bones.
void draw_skeleton(vtkPolyData& skeleton, const Skeleton& joints, const Frame& frame);

}  // namespace garmentfit

#endif
