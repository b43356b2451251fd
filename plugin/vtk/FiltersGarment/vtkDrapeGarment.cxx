// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkDrapeGarment.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkDrapeGarment);

vtkDrapeGarment::vtkDrapeGarment() : vtkFitFilter("drape") { }
