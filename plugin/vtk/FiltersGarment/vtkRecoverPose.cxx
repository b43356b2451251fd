// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkRecoverPose.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkRecoverPose);

vtkRecoverPose::vtkRecoverPose() : vtkFitFilter("recover") { }
