// SPDX-License-Identifier: GPL-3.0-or-later

// Named arrays of a scene as arrays of vtkPolyData, and back.

#ifndef named_arrays_h
#define named_arrays_h

#include "garmentfit/filters/scene_arrays.h"

#include "vtkNew.h"
#include "vtkSmartPointer.h"

class vtkDataArray;
class vtkDoubleArray;
class vtkPolyData;

namespace garmentfit {

Rows rows_of(vtkDataArray& array);
vtkNew<vtkDoubleArray> array_of(const char* name, const Eigen::Ref<const Rows>& rows);
/// Shares the memory under another name. Renaming the array itself would rename it in the input.
vtkSmartPointer<vtkDataArray> under_name(vtkDataArray& array, const char* name);

void put(vtkPolyData& data, const MeshArrays& arrays);
/// Looks among the arrays of points and of the field.
FindArray find_in(vtkPolyData& data);

}  // namespace garmentfit

#endif
