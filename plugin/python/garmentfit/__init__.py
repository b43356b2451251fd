# SPDX-License-Identifier: GPL-3.0-or-later
"""Dresses a 3D body of any shape and pose in garments made for somebody else.

>>> import garmentfit
>>> body = garmentfit.read_mesh("walking_woman.ply")
>>> skirt = garmentfit.read_mesh("skirt.ply")
>>> dressed = garmentfit.dress(body, skirt)
>>> dressed.certified, dressed.garments[0].positions
"""
from ._core import Cancelled, InvalidInput, SolverFailure, TimeLimitReached, __version__
from ._meshes import Mesh, read_mesh
from ._steps import (Certificate, Conflict, DressedGarment, Dressing, Fit, FitOfGarment, FitVerdict, Frame,
                     Garment, Girth, Overstretch, PlaceVerdict, Rig, dress, drape_garment, fit_skeleton,
                     recover_pose, rig_body)

__all__ = [
    "Cancelled", "Certificate", "Conflict", "DressedGarment", "Dressing", "Fit", "FitOfGarment", "FitVerdict",
    "Frame", "Garment", "Girth", "InvalidInput", "Mesh", "Overstretch", "PlaceVerdict", "Rig", "SolverFailure",
    "TimeLimitReached", "__version__", "drape_garment", "dress", "fit_skeleton", "read_mesh",
    "recover_pose", "rig_body",
]
