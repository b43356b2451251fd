# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes of bodies and garments, and their files."""
from __future__ import annotations

import os
from pathlib import Path
from typing import Any, List, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._errors import invalid_input
from ._usd_input import ENDINGS, read_usd

Positions = npt.NDArray[np.float64]
Triangles = npt.NDArray[np.int32]
MeshLike = Any  # Mesh, (positions, triangles), vtkPolyData, or an object with vertices and faces as trimesh's


class Mesh:
    """Positions (n x 3, in any unit, any axis up) and triangles (m x 3) of a body or a garment.

    uvs: texture coordinates of the vertices (n x 2), or of the corners of the triangles (m x 3 x 2). Where it has them,
    cloth is stiffer along v, its warp. A mesh that was read from a file has those of the file.
    """

    def __init__(self, positions: npt.ArrayLike, triangles: npt.ArrayLike, *, name: str = "the garment",
                 file: Optional[_core.MeshFile] = None, left: Optional[_core.StrippedBody] = None,
                 uvs: Optional[npt.ArrayLike] = None) -> None:
        self.positions: Positions = _numbers(positions, "positions")
        self.triangles: Triangles = _indices(triangles)
        self.uvs = None if uvs is None else _uvs(uvs, len(self.positions), len(self.triangles))
        self.name = name
        self.file = file  #: what it was read from, with UVs, materials and textures; None for arrays
        self._left = left

    def __repr__(self) -> str:
        return f"Mesh({self.name!r}, {len(self.positions)} vertices, {len(self.triangles)} triangles)"

    def corner_uvs(self) -> Positions:
        """u0 v0 u1 v1 u2 v2 of each triangle, m x 6; no rows where it has none."""
        if self.uvs is None:
            return np.empty((0, 6)) if self.file is None else self.file.corner_uvs
        of_corners = self.uvs if self.uvs.ndim == 3 else self.uvs[self.triangles]
        return np.ascontiguousarray(of_corners.reshape(-1, 6))

    @property
    def stripped(self) -> List[str]:
        """Names of the parts of the file that were left out as clothes."""
        return [] if self._left is None else self._left.stripped

    @property
    def scenery(self) -> List[str]:
        """Names of the parts of the file that were left out as no joint moves them and they lie away from what joints
        move."""
        return [] if self._left is None else self._left.scenery

    def write(self, path: Union[str, "os.PathLike[str]"], positions: Optional[npt.ArrayLike] = None) -> None:
        """Writes the file that this mesh was read from with other positions. Vertices, order, UVs, groups and materials
        stay; normals are computed anew. A mesh that was made from arrays is written as PLY."""
        moved = self.positions if positions is None else _numbers(positions, "positions")
        if self.file is not None:
            self.file.write(Path(path), moved)
        elif Path(path).suffix.lower() == ".ply":
            _core.write_mesh(Path(path), moved, self.triangles)
        else:
            raise invalid_input("wrong_call", f"{path}: a mesh made from arrays needs a name that ends in .ply")


def read_mesh(path: Union[str, "os.PathLike[str]"], *, reconstruct: bool = False, wears: str = "keep") -> Mesh:
    """Reads OBJ, PLY, OFF, STL, glTF, GLB, FBX or COLLADA; and USD with the extra `usd`, whose meshes come in metres
    with +y up, without materials or skin. `reconstruct` makes a surface from points without faces.

    wears: what is done with clothes that an avatar wears in its file: "keep" (all parts are the body), or "strip"
    (parts that are named as clothes and have skin under them are left out; `Mesh.stripped` names them).
    """
    path = Path(path)
    if path.suffix.lower() in ENDINGS:
        return Mesh(*read_usd(path), name=path.name)
    file = _core.MeshFile.read_points(path) if reconstruct else _core.MeshFile.read(path)
    triangles = file.triangles
    if reconstruct and len(triangles) == 0:
        triangles = _core.reconstruct_surface(file.positions)
    left = _core.find_body(file, wears)
    if left is not None:
        triangles = _core.triangles_of_body(file, left)
    return Mesh(file.positions, triangles, name=path.name, file=file, left=left)


def as_mesh(given: MeshLike) -> Mesh:
    if isinstance(given, Mesh):
        return given
    if hasattr(given, "GetPolys"):  # vtkPolyData, PyVista's too
        from .vtk import mesh_of, uvs_of
        return Mesh(*mesh_of(given, "the mesh"), uvs=uvs_of(given))
    if hasattr(given, "vertices") and hasattr(given, "faces"):  # trimesh
        return Mesh(given.vertices, given.faces, uvs=getattr(getattr(given, "visual", None), "uv", None))
    try:
        positions, triangles = given
    except (TypeError, ValueError, KeyError):
        kind = type(given).__name__
        raise invalid_input("wrong_call", f"{kind} is no mesh; give a Mesh, or positions and triangles") from None
    return Mesh(positions, triangles)


def _numbers(values: npt.ArrayLike, what: str) -> Positions:
    """Copies only where the type is not float64."""
    array = np.ascontiguousarray(values, dtype=np.float64)
    if array.ndim != 2 or array.shape[1] != 3:
        raise invalid_input("wrong_call", f"{what} are an array of shape {array.shape}; give n x 3")
    return array


def _uvs(values: npt.ArrayLike, vertices: int, triangles: int) -> npt.NDArray[np.float64]:
    array = np.ascontiguousarray(values, dtype=np.float64)
    if array.shape not in ((vertices, 2), (triangles, 3, 2)):
        raise invalid_input("wrong_call", f"uvs are an array of shape {array.shape}; give {vertices} x 2, of the "
                                          f"vertices, or {triangles} x 3 x 2, of the corners of the triangles")
    return array


def _indices(values: npt.ArrayLike) -> Triangles:
    array = np.asarray(values)
    if array.ndim != 2 or array.shape[1] != 3 or array.dtype.kind not in "iu":
        raise invalid_input("wrong_call", f"triangles are {array.dtype} of shape {array.shape}; give integers, m x 3")
    if array.size and (array.min() < 0 or array.max() > np.iinfo(np.int32).max):
        raise invalid_input("bad_index",
                            f"triangles refer to vertices from {array.min()} to {array.max()}; count vertices from 0")
    return np.ascontiguousarray(array, dtype=np.int32)
