// SPDX-License-Identifier: GPL-3.0-or-later

// What a scene looks like as arrays of vtkPolyData; vtkFitFilter.h lists them.

#ifndef scene_data_h
#define scene_data_h

#include <string>
#include <vector>

#include "filters/filters.h"
#include "fit/units.h"

class vtkDataObject;
class vtkPolyData;

namespace fit {

/// Points as numbers, in the file's units and axes, and polygons as fans of triangles.
/// @throws InvalidInput where there are no polygons, naming `what` it is.
TriangleMesh mesh_of(vtkPolyData& data, const std::string& what);
/// The same with the points that the array `name` keeps, where there is such an array.
TriangleMesh mesh_at(vtkPolyData& data, const char* name, const std::string& what);

/// Leaves of a composite, or the one mesh. @throws InvalidInput where a leaf is no vtkPolyData.
std::vector<vtkPolyData*> garments_in(vtkDataObject& data);
/// Their names, as their blocks or else their places have them.
std::vector<std::string> garment_names_in(vtkDataObject& data);
GarmentType given_type(vtkPolyData& garment);

// ---- what filters hand to each other. Readers throw InvalidInput naming the filter that makes what is missing ----------------

void put_frame(vtkPolyData& data, const char* name, const Frame& frame);
Frame frame_in(vtkPolyData& data, const char* name);
bool has_frame(vtkPolyData& data, const char* name);

void put_rig(vtkPolyData& body, const Rig& rig);
Rig rig_in(vtkPolyData& body);

void put_fits(vtkPolyData& body, const std::vector<FitResult>& fits);
std::vector<FitResult> fits_in(vtkPolyData& body);

void put_pose(vtkPolyData& body, const Pose& pose);
Pose pose_in(vtkPolyData& body);

// ---- what users look at ------------------------------------------------------------------------------------------------------

/// Moves the points to `metres`, keeps those of before as `name`, and turns point normals along.
void move_points(vtkPolyData& data, const char* name, const Positions& metres, const Triangles& triangles,
                 const Frame& frame);
/// Takes back what move_points did to an input: the points become those kept as `name`, the same memory.
void restore_points(vtkPolyData& data, const char* name);

void put_dressing(vtkPolyData& body, const Dressing& dressing, const std::string& note, double metres_per_unit);
void put_fit(vtkPolyData& garment, const FitResult& fit);
void put_worn(vtkPolyData& garment, const Dressing& dressing, std::size_t i, double metres_per_unit);
void put_map(vtkPolyData& garment, const FitMap& map, double metres_per_unit);
void draw_skeleton(vtkPolyData& skeleton, const Skeleton& joints, const Frame& frame);

}  // namespace fit

#endif
