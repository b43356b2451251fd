# SPDX-License-Identifier: GPL-3.0-or-later
"""GarmentFit's filters for Debian's VTK: vtkRigBody, vtkFitSkeleton, vtkDrapeGarment, vtkRecoverPose, vtkDressBody."""
from .vtkFiltersGarment import *  # noqa: F401,F403
