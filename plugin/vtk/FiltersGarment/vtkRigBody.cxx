// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkRigBody.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkRigBody);

vtkRigBody::vtkRigBody() : vtkFitFilter("rig") { }
