// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkDressBody.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkDressBody);

vtkDressBody::vtkDressBody() : vtkFitFilter("dress") { }
