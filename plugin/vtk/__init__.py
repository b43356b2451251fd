# SPDX-License-Identifier: GPL-3.0-or-later
"""GarmentFit for Debian's VTK: vtkRigBody, vtkFitSkeleton, vtkDrapeGarment, vtkRecoverPose, vtkDressBody and
vtkOutfitWriter."""
from .vtkFiltersGarment import *  # noqa: F401,F403
