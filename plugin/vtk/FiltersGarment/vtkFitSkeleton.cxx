// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkFitSkeleton.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkFitSkeleton);

vtkFitSkeleton::vtkFitSkeleton() : vtkFitFilter("fit") { }
