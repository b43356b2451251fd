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

/// Points as numbers, in the file's units and axes, and polygons as fans of triangles.
/// @throws InvalidInput where there are no polygons, naming `what` it is.
TriangleMesh mesh_of(vtkPolyData& data, const std::string& what);
/// The same with the points that the array `name` keeps, where there is such an array.
TriangleMesh mesh_at(vtkPolyData& data, const char* name, const std::string& what);

/// Leaves of a composite, or the one mesh. @throws InvalidInput where a leaf is no vtkPolyData.
std::vector<vtkPolyData*> garments_in(vtkDataObject& data);
/// Their names, as their blocks or else their places have them.
std::vector<std::string> garment_names_in(vtkDataObject& data);
/// A string GarmentType in its field data. @throws InvalidInput listing the types.
GarmentType given_type(vtkPolyData& garment);

/// Moves the points to `metres`, keeps those of before as `name`, and turns point normals along.
void move_points(vtkPolyData& data, const char* name, const Positions& metres, const Triangles& triangles,
                 const Frame& frame);
/// Takes back what move_points did to an input: the points become those kept as `name`, the same memory.
void restore_points(vtkPolyData& data, const char* name);
/// Lines from joint to joint, with their names.
void draw_skeleton(vtkPolyData& skeleton, const Skeleton& joints, const Frame& frame);

}  // namespace garmentfit

#endif
