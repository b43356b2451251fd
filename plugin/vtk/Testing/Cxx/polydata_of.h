// SPDX-License-Identifier: GPL-3.0-or-later

// A mesh as tests and benchmarks feed it to a pipeline.

#ifndef polydata_of_h
#define polydata_of_h

#include "garmentfit/mesh.h"

#include "vtkCellArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

namespace garmentfit {

inline vtkSmartPointer<vtkPolyData> polydata_of(const TriangleMesh& mesh)
{
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v)
        points->InsertNextPoint(mesh.positions.row(v).data());
    vtkNew<vtkCellArray> triangles;
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
        triangles->InsertNextCell({ mesh.triangles(f, 0), mesh.triangles(f, 1), mesh.triangles(f, 2) });
    auto data = vtkSmartPointer<vtkPolyData>::New();
    data->SetPoints(points);
    data->SetPolys(triangles);
    return data;
}

}  // namespace garmentfit

#endif
