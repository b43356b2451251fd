// SPDX-License-Identifier: GPL-3.0-or-later

// The smallest program that uses the installed module: no body, so an error and empty outputs.

#include "vtkDressBody.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

int main()
{
    vtkNew<vtkDressBody> dress;
    vtkNew<vtkPolyData> nothing;
    dress->SetInputData(0, nothing);
    dress->SetInputData(1, nothing);
    dress->SetDensity(0.3);
    dress->Update();
    const bool refused = dress->GetErrorCode() == vtkFitFilter::InvalidInput;
    return refused && dress->GetOutput()->GetNumberOfPoints() == 0 ? 0 : 1;
}
