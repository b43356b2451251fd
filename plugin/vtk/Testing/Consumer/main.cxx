// SPDX-License-Identifier: GPL-3.0-or-later

// A program that uses the installed module: empty input is an error, and a body from a file is dressed.
//   consumer BODY GARMENT TYPE

#include <cstdlib>
#include <iostream>

#include "vtkDataArray.h"
#include "vtkDressBody.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPLYReader.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

namespace {

bool refuses_nothing()
{
    vtkNew<vtkDressBody> dress;
    vtkNew<vtkPolyData> nothing;
    dress->SetInputData(0, nothing);
    dress->SetInputData(1, nothing);
    dress->Update();
    return dress->GetErrorCode() == vtkFitFilter::InvalidInput && dress->GetOutput()->GetNumberOfPoints() == 0;
}

bool dresses(const char* body_file, const char* garment_file, const char* type)
{
    vtkNew<vtkPLYReader> body, garment;
    body->SetFileName(body_file);
    garment->SetFileName(garment_file);
    vtkNew<vtkDressBody> dress;
    dress->SetInputConnection(0, body->GetOutputPort());
    dress->SetInputConnection(1, garment->GetOutputPort());
    dress->SetTypeByName(type);
    dress->Update();
    auto* worn = vtkPolyData::SafeDownCast(dress->GetOutputDataObject(1));
    if (dress->GetErrorCode() != vtkErrorCode::NoError || !worn->GetPointData()->HasArray("Ease"))
        return false;
    std::cout << worn->GetNumberOfPoints() << " vertices, gap "
              << worn->GetFieldData()->GetArray("GarmentMinDistance")->GetComponent(0, 0) << '\n';
    return worn->GetNumberOfPoints() == garment->GetOutput()->GetNumberOfPoints()
        && dress->GetOutput()->GetFieldData()->GetArray("Certified")->GetComponent(0, 0) == 1;
}

}  // namespace

int main(int argc, char** argv)
{
    return argc == 4 && refuses_nothing() && dresses(argv[1], argv[2], argv[3]) ? EXIT_SUCCESS : EXIT_FAILURE;
}
